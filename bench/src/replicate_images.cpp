#include "replicate_images.h"

#include "pictures.h"
#include "row_store.h"

#include <koksma/film/exr.h>

#include <fmt/format.h>

namespace koksma {

std::string image_name(const Row& r) { return fmt::format("images/{}-{}-{}-{}.exr", r.scene, file_stem(r.sampler), r.spp, r.replicate); }

void save_replicate(const std::filesystem::path& folder, const Row& row, const std::vector<float>& image) {
    ExrImage exr;
    exr.width = row.crop[2];
    exr.height = row.crop[3];
    exr.data_x = row.crop[0];
    exr.data_y = row.crop[1];
    exr.display_width = row.film[0];
    exr.display_height = row.film[1];
    exr.set_rgb(image);
    exr.attributes = {{"koksma:row", key_of(row)}};
    write_exr(folder / image_name(row), exr);
}

std::optional<std::vector<float>> load_replicate(const std::filesystem::path& folder, const Row& row) {
    const std::filesystem::path file = folder / image_name(row);
    if (!std::filesystem::exists(file)) return std::nullopt;
    try {
        const ExrImage exr = read_exr(file);
        const auto key = exr.attributes.find("koksma:row");
        if (key == exr.attributes.end() || key->second != key_of(row)) return std::nullopt;
        return exr.rgb();
    } catch (const Error&) {
        return std::nullopt;  // not readable: as good as not there
    }
}

}  // namespace koksma
