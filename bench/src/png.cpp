#include "png.h"

#include <koksma/film/atomic_file.h>
#include <koksma/math/vec3.h>
#include <koksma/sampling/error.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

namespace koksma {

float exposure_for(std::span<const float> rgb) {
    std::vector<float> values;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3)
        if (const float y = luminance({rgb[i], rgb[i + 1], rgb[i + 2]}); y > 0.0f && std::isfinite(y)) values.push_back(y);
    if (values.empty()) return 1.0f;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return 0.6f / *at;
}

void write_png(const std::filesystem::path& file, std::span<const float> rgb, int width, int height, float exposure) {
    std::vector<unsigned char> bytes(rgb.size());
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const float v = std::clamp(std::isfinite(rgb[i]) ? rgb[i] * exposure : 0.0f, 0.0f, 1.0f);
        const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
        bytes[i] = static_cast<unsigned char>(s * 255.0f + 0.5f);
    }
    // stbi_write_png() itself would not notice a full disk.
    const auto append = [](void* stream, void* data, int size) { static_cast<std::ofstream*>(stream)->write(static_cast<const char*>(data), size); };
    write_atomically(file, [&](const std::filesystem::path& path) {
        std::ofstream out(path, std::ios::binary);
        const bool made = stbi_write_png_to_func(append, &out, width, height, 3, bytes.data(), 3 * width) != 0;
        out.flush();
        if (!made || !out) throw Error("the disk is full or the folder is not writable");
    });
}

}  // namespace koksma
