#pragma once
// Reading Mitsuba 3 scene files.

#include <koksma/scene/description.h>

#include <map>
#include <string>

namespace koksma {

/// Values for the file's <default> parameters, as given by -D name=value.
using SceneParameters = std::map<std::string, std::string>;

/// Reads a scene in Mitsuba 3's XML format with the meshes and images that it names, with Mitsuba's meanings.
/// Supported: docs/scenes.md. Anything else is refused, never skipped.
/// @throws Error "file:line:column: what was found, what was expected"
[[nodiscard]] SceneDescription load_scene(const std::filesystem::path& file, const SceneParameters& parameters = {});

/// Reads one mesh; v counts upwards, as the file has it. Polygons become fans. No normals are computed. @throws Error
[[nodiscard]] MeshData load_obj(const std::filesystem::path& file);
/// Reads one mesh, ascii or binary. Polygons become fans. No normals are computed. @throws Error
[[nodiscard]] MeshData load_ply(const std::filesystem::path& file);
/// Reads one mesh of a Mitsuba file, versions 3 and 4. No normals are computed. @throws Error
[[nodiscard]] MeshData load_serialized(const std::filesystem::path& file, std::uint32_t index = 0);
/// Reads a volume of Mitsuba's format, version 3. @throws Error, also for values that are not finite
[[nodiscard]] VolumeGrid load_vol(const std::filesystem::path& file);
/// Reads PNG, JPEG, HDR or EXR to linear RGB. @param raw  take 8-bit values as they are, without the sRGB curve
/// @throws Error, also for NaN, infinite or negative texels
[[nodiscard]] Image load_image(const std::filesystem::path& file, bool raw);

}  // namespace koksma
