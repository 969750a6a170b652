// PNG, JPEG and HDR by stb_image, whose implementation is in this file alone.

#include "image.h"
#include "image_claims.h"

#include <koksma/sampling/error.h>

#include <climits>
#include <cmath>
#include <memory>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif
#pragma GCC diagnostic pop

namespace koksma::loader {
namespace {

/// IEC 61966-2-1, the curve of sRGB, from [0, 1] to linear.
double srgb_to_linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

std::vector<float> make_decoding_table(unsigned levels, bool raw) {
    std::vector<float> table(levels);
    for (unsigned i = 0; i < levels; ++i) {
        const double v = double(i) / double(levels - 1);
        table[i] = static_cast<float>(raw ? v : srgb_to_linear(v));
    }
    return table;
}

/// Made once: 65536 powers take longer than most pictures.
const std::vector<float>& decoding_table(unsigned levels, bool raw) {
    static const std::vector<float> bytes[2] = {make_decoding_table(256, false), make_decoding_table(256, true)};
    if (levels == 256) return bytes[raw ? 1 : 0];
    static const std::vector<float> words[2] = {make_decoding_table(65536, false), make_decoding_table(65536, true)};
    return words[raw ? 1 : 0];
}

struct FreePixels {
    void operator()(void* pixels) const noexcept { stbi_image_free(pixels); }
};

template <class T, class Decode>
Image decode(T* loaded, int width, int height, const std::string& name, Decode to_linear) {
    const std::unique_ptr<T, FreePixels> pixels(loaded);
    if (!pixels) throw Error(name + ": cannot be decoded: " + stbi_failure_reason());
    Image image{width, height, {}};
    image.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        for (int c = 0; c < 3; ++c) image.texels[i][c] = to_linear(pixels.get()[3 * i + static_cast<std::size_t>(c)]);
    return image;
}

}  // namespace

Image decode_stb(const std::string& bytes, const std::string& name, bool raw) {
    if (bytes.size() > INT_MAX) throw Error(name + ": images of 2 GiB and more are not supported");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    check_claims(bytes, name);  // before anything is decoded
    if (stbi_info_from_memory(data, size, &width, &height, &channels) != 0) check_size(bytes, width, height, name);
    if (stbi_is_hdr_from_memory(data, size)) {
        float* loaded = stbi_loadf_from_memory(data, size, &width, &height, &channels, 3);
        return decode(loaded, width, height, name, [](float v) { return v; });
    }
    if (stbi_is_16_bit_from_memory(data, size)) {
        const auto& table = decoding_table(65536, raw);
        stbi_us* loaded = stbi_load_16_from_memory(data, size, &width, &height, &channels, 3);
        return decode(loaded, width, height, name, [&](stbi_us v) { return table[v]; });
    }
    const auto& table = decoding_table(256, raw);
    stbi_uc* loaded = stbi_load_from_memory(data, size, &width, &height, &channels, 3);
    return decode(loaded, width, height, name, [&](stbi_uc v) { return table[v]; });
}

}  // namespace koksma::loader
