#pragma once
// The two readers of pictures.

#include <koksma/scene/description.h>

#include <filesystem>
#include <string>

namespace koksma::loader {

/// PNG and JPEG (with the sRGB curve unless `raw`), Radiance HDR (linear). Alpha is dropped. @throws Error
[[nodiscard]] Image decode_stb(const std::string& bytes, const std::string& name, bool raw);

/// OpenEXR with channels R, G, B or Y. Alpha is dropped. @throws Error
[[nodiscard]] Image decode_exr(const std::filesystem::path& file);

}  // namespace koksma::loader
