#pragma once
// OpenEXR files: images of named float channels with string attributes.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace koksma {

/// An image in memory as an EXR file holds it: planes of shape (height, width).
struct ExrImage {
    std::int32_t width = 0, height = 0;
    std::int32_t data_x = 0, data_y = 0;                ///< where its top left pixel lies on the full film
    std::int32_t display_width = 0, display_height = 0;  ///< full film; 0: the image itself
    std::map<std::string, std::vector<float>> channels;
    std::map<std::string, std::string> attributes;      ///< ours: "koksma:sampler", ...

    /// Channels R, G, B interleaved, shape (height, width, 3). A file with Y only is grey. @throws Error if it has neither
    [[nodiscard]] std::vector<float> rgb() const;
    void set_rgb(const std::vector<float>& interleaved);
};

/// Writes 32-bit float channels, ZIP-compressed, without loss. The file appears whole or not at all (a temporary file beside it is renamed).
/// @throws Error with the path and the reason
void write_exr(const std::filesystem::path& file, const ExrImage& image);

/// Reads the data window of the first part, half and float channels. @throws Error with the path and the reason
[[nodiscard]] ExrImage read_exr(const std::filesystem::path& file);

}  // namespace koksma
