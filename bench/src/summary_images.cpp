#include "summary_images.h"

#include "curve.h"
#include "numpy_file.h"
#include "pictures.h"
#include "replicate_images.h"

#include <koksma/film/exr.h>
#include <koksma/measure/image_error.h>
#include <koksma/measure/rmse_estimate.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

void write_map(const std::filesystem::path& file, const std::vector<double>& values, int width, int height) {
    const std::vector<float> floats(values.begin(), values.end());
    write_npy(file, floats, {static_cast<std::uint64_t>(height), static_cast<std::uint64_t>(width)});
}

struct Replicates {
    std::vector<std::vector<float>> images;
    PixelStatistics pixels;
};

Json blurred_json(const Replicates& r, const std::vector<float>& reference, int width, int height) {
    Json out = Json::array();
    for (const double sigma : kBlurs) {
        std::vector<double> mse;
        for (const auto& image : r.images) mse.push_back(blurred_mse(image, reference, width, height, sigma));
        const RmseEstimate e = rmse_estimate(mse, kConfidence);
        Json line = {{"sigma", sigma}};
        line["rmse"] = interval_json(e.rmse.value, e.rmse.lo, e.rmse.hi);
        out.push_back(line);
    }
    return out;
}

}  // namespace

std::filesystem::path reference_image(const std::filesystem::path& folder, const std::string& scene, const char* what) {
    return folder / "images" / fmt::format("{}-reference-{}.exr", scene, what);
}

void save_reference_images(const std::filesystem::path& folder, const std::string& scene, const Reference& reference) {
    ExrImage exr;
    exr.width = reference.key.rect.width;
    exr.height = reference.key.rect.height;
    exr.set_rgb(reference.mean);
    write_exr(reference_image(folder, scene, "mean"), exr);
    exr.set_rgb(reference.variance);
    write_exr(reference_image(folder, scene, "variance"), exr);
}

void add_image_errors(const std::filesystem::path& folder, const Json& header, const std::vector<Row>& rows, Json& summary) {
    const std::uint64_t spp = header.at("crop_spp");
    for (Json& scene : summary.at("scenes")) {
        const std::string name = scene.at("name");
        for (Json& s : scene.at("samplers")) s["image_error"] = nullptr;
        if (!std::filesystem::exists(reference_image(folder, name, "mean"))) continue;  // of an older program
        const int width = scene.at("crop")[2], height = scene.at("crop")[3];
        const std::vector<float> mean = read_exr(reference_image(folder, name, "mean")).rgb(), variance = read_exr(reference_image(folder, name, "variance")).rgb();
        std::map<std::string, Replicates> found;
        for (const Row& row : rows)
            if (row.scene == name && row.layout == 0 && row.prefix_of == 0 && row.spp == spp && row.randomized)
                if (auto image = load_replicate(folder, row)) found[row.sampler].images.push_back(std::move(*image));
        std::erase_if(found, [](const auto& item) { return item.second.images.size() < 2; });
        for (auto& [sampler, r] : found) r.pixels = pixel_statistics(r.images, mean, variance);
        const auto random = found.find("random");
        for (Json& s : scene.at("samplers")) {
            const auto at = found.find(s.at("sampler").get<std::string>());
            if (at == found.end()) continue;
            const Replicates& r = at->second;
            std::filesystem::create_directories(folder / "maps");
            Json maps;
            const std::pair<const char*, const std::vector<double>*> kinds[] = {{"mse", &r.pixels.mse}, {"variance", &r.pixels.variance}, {"bias_z", &r.pixels.bias_z}};
            for (const auto& [kind, values] : kinds) {
                const std::string file = fmt::format("maps/{}-{}-{}.npy", name, file_stem(at->first), kind);
                write_map(folder / file, *values, width, height);
                maps[kind] = file;
            }
            std::vector<double> sizes;
            for (const double z : r.pixels.bias_z)
                if (std::isfinite(z)) sizes.push_back(std::abs(z));
            const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
            if (!sizes.empty()) std::nth_element(sizes.begin(), middle, sizes.end());
            s["image_error"] = {{"spp", spp},
                                {"replicates", r.images.size()},
                                {"spectrum", error_spectrum(r.images, mean, width, height)},
                                {"blurred", blurred_json(r, mean, width, height)},
                                {"bias_z_median", sizes.empty() ? Json() : Json(*middle)},
                                {"median_pixel_gain", random == found.end() || random == at ? Json() : number(median_pixel_gain(r.pixels.mse, random->second.pixels.mse))},
                                {"maps", maps}};
        }
    }
}

}  // namespace koksma
