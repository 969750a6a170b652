// The crops themselves, as data for a report's viewer and for a paper.

#include "numpy_file.h"
#include "pictures.h"
#include "replicate_images.h"
#include "summary_images.h"

#include <koksma/film/exr.h>

#include <fmt/format.h>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// @return  the paths of both files, without their endings, relative to folder
std::string write_crop(const std::filesystem::path& folder, const std::string& name, const std::vector<float>& image, int width, int height) {
    const std::string stem = "crops/" + name;
    ExrImage exr;
    exr.width = width;
    exr.height = height;
    exr.set_rgb(image);
    write_exr(folder / (stem + ".exr"), exr);
    write_npy(folder / (stem + ".npy"), image, {static_cast<std::uint64_t>(height), static_cast<std::uint64_t>(width), 3});
    return stem;
}

}  // namespace

void add_crops(const std::filesystem::path& folder, const Json& header, const std::vector<Row>& rows, Json& summary) {
    const std::uint64_t spp = header.at("crop_spp");
    std::filesystem::create_directories(folder / "crops");
    for (Json& scene : summary.at("scenes")) {
        const std::string name = scene.at("name");
        const int width = scene.at("crop")[2], height = scene.at("crop")[3];
        scene["reference_data"] = scene["reference_exr"] = nullptr;
        if (std::filesystem::exists(reference_image(folder, name, "mean"))) {  // not in results of an older program
            const std::string stem = write_crop(folder, name + "-reference", read_exr(reference_image(folder, name, "mean")).rgb(), width, height);
            scene["reference_data"] = stem + ".npy";
            scene["reference_exr"] = stem + ".exr";
        }
        for (Json& s : scene.at("samplers")) {
            s["crop_data"] = s["crop_exr"] = nullptr;
            for (const Row& row : rows) {
                if (row.scene != name || row.sampler != s.at("sampler") || row.replicate != 0 || row.layout != 0 || row.prefix_of != 0 || row.spp != spp) continue;
                const auto image = load_replicate(folder, row);
                if (!image) continue;
                const std::string stem = write_crop(folder, name + "-" + file_stem(row.sampler), *image, width, height);
                s["crop_data"] = stem + ".npy";
                s["crop_exr"] = stem + ".exr";
            }
        }
    }
}

}  // namespace koksma
