// Which reader a picture file needs, and what all pictures must satisfy.

#include "image.h"

#include "fail.h"
#include "files.h"

#include <koksma/scene/load.h>

#include <algorithm>
#include <cmath>

namespace koksma {

Image load_image(const std::filesystem::path& file, bool raw) {
    using namespace loader;
    const std::string bytes = read_file(file), name = file.string();
    const std::string_view start(bytes);
    Image image;
    if (start.starts_with("\x76\x2f\x31\x01"))
        image = decode_exr(file);
    else if (start.starts_with("\x89PNG") || start.starts_with("\xff\xd8\xff") || start.starts_with("#?RADIANCE") ||
             start.starts_with("#?RGBE"))
        image = decode_stb(bytes, name, raw);
    else
        throw Error(name + ": this is not an image that can be read; supported: PNG, JPEG, Radiance HDR, OpenEXR");

    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const Rgb& t = image.texels[i];
        const auto good = [](float v) { return std::isfinite(v) && v >= 0.0f; };
        if (!good(t.r) || !good(t.g) || !good(t.b)) {
            const auto width = static_cast<std::size_t>(image.width);
            throw Error(fmt::format("{}: texel ({}, {}) is {} {} {}; texels must be finite and not negative", name, i % width, i / width,
                                    t.r, t.g, t.b));
        }
    }
    return image;
}

}  // namespace koksma
