#pragma once
// Pictures for people: sRGB PNGs.

#include <filesystem>
#include <span>

namespace koksma {

/// The factor that puts the 90th percentile of the positive luminances at 0.6 (1 for a black image).
[[nodiscard]] float exposure_for(std::span<const float> rgb);

/// @param rgb  linear, shape (height, width, 3)
void write_png(const std::filesystem::path& file, std::span<const float> rgb, int width, int height, float exposure);

}  // namespace koksma
