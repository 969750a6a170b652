#pragma once
// What the readers of plugins share while one scene is loaded.

#include "files.h"
#include "properties.h"

#include <koksma/scene/description.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace koksma::loader {

/// A mesh as the file has it, shared by the shapes that name it.
struct MeshFile {
    std::shared_ptr<const MeshData> as_written;
    std::shared_ptr<const MeshData> flipped_uv;     ///< the same with v -> 1 - v, made when asked for
    std::shared_ptr<const MeshData> smooth[2];      ///< with computed normals, by flip of v; for transforms that keep angles
    std::shared_ptr<const MeshData> no_normals[2];  ///< without normals, by flip of v
};

struct Context {
    SceneDescription& scene;
    IdTable ids;
    SearchPath search;

    std::map<const Element*, std::uint32_t> materials;  ///< BSDF elements already in scene.materials
    std::optional<std::uint32_t> black_material;
    std::map<std::string, MeshFile> meshes;
    std::map<std::pair<std::string, bool>, std::shared_ptr<const Image>> images;  ///< by file and `raw`
    std::set<const Element*> attached_emitters;
    std::map<const Element*, std::uint32_t> media{};                   ///< medium elements already in scene.media
    std::map<std::string, std::shared_ptr<const VolumeGrid>> grids{};  ///< by file
    std::map<const Element*, std::uint32_t> groups{};                    ///< shapegroup elements already in scene.groups
};

}  // namespace koksma::loader
