#include "row.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace koksma {

namespace {

/// JSON has no NaN (the relMSE against a black reference); it is written as null. Nor have rows of older programs all keys.
double number_or_nan(const nlohmann::ordered_json& j, const char* key) {
    const auto it = j.find(key);
    return it == j.end() || it->is_null() ? std::numeric_limits<double>::quiet_NaN() : it->get<double>();
}

}  // namespace

void to_json(nlohmann::ordered_json& j, const Row& r) {
    j = {{"kind", "render"},
         {"row_format", kRowFormat},
         {"scene", r.scene},
         {"scene_hash", r.scene_hash},
         {"sampler", r.sampler},
         {"sampler_version", r.sampler_version},
         {"randomized", r.randomized},
         {"spp", r.spp},
         {"replicate", r.replicate},
         {"layout", r.layout},
         {"prefix_of", r.prefix_of},
         {"seed", r.seed},
         {"film", {r.film[0], r.film[1]}},
         {"crop", {r.crop[0], r.crop[1], r.crop[2], r.crop[3]}},
         {"max_depth", r.max_depth},
         {"rr_depth", r.rr_depth},
         {"effects", r.effects},
         {"dimensions", r.dimensions},
         {"kernel", r.kernel},
         {"mse", r.all.mse},
         {"mse_raw", r.all.mse_raw},
         {"rmse", r.all.mse > 0.0 ? nlohmann::ordered_json(std::sqrt(r.all.mse)) : nlohmann::ordered_json()},
         {"relmse", r.all.relmse},
         {"relmse_raw", r.all.relmse_raw},
         {"mae", r.all.mae},
         {"smape", r.all.smape},
         {"flip", r.all.flip},
         {"masked",
          {{"pixels", r.masked.pixels},
           {"mse", r.masked.mse},
           {"relmse", r.masked.relmse},
           {"mae", r.masked.mae},
           {"smape", r.masked.smape},
           {"flip", r.masked.flip}}},
         {"mean_rgb", {r.mean_rgb[0], r.mean_rgb[1], r.mean_rgb[2]}},
         {"wall_seconds", r.wall_seconds},
         {"cpu_seconds", r.cpu_seconds},
         {"sampler_seconds", r.sampler_seconds},
         {"sampler_share", r.cpu_seconds > 0.0 ? r.sampler_seconds / r.cpu_seconds : 0.0},
         {"paths", r.paths},
         {"rays", r.rays},
         {"invalid_samples", r.invalid_samples},
         {"threads", r.threads},
         {"fill", r.fill},
         {"estimator_version", r.estimator_version},
         {"reference", r.reference},
         {"reference_content", r.reference_content},
         {"commit", r.commit},
         {"machine", r.machine},
         {"isa", r.isa}};
}

void from_json(const nlohmann::ordered_json& j, Row& r) {
    j.at("scene").get_to(r.scene);
    j.at("scene_hash").get_to(r.scene_hash);
    j.at("sampler").get_to(r.sampler);
    j.at("sampler_version").get_to(r.sampler_version);
    j.at("randomized").get_to(r.randomized);
    j.at("spp").get_to(r.spp);
    j.at("replicate").get_to(r.replicate);
    r.layout = j.value("layout", 0);  // rows of older programs have none
    r.prefix_of = j.value("prefix_of", std::uint64_t{0});
    j.at("seed").get_to(r.seed);
    for (std::size_t i = 0; i < 2; ++i) r.film[i] = j.at("film").at(i);
    for (std::size_t i = 0; i < 4; ++i) r.crop[i] = j.at("crop").at(i);
    j.at("max_depth").get_to(r.max_depth);
    j.at("rr_depth").get_to(r.rr_depth);
    j.at("effects").get_to(r.effects);
    j.at("dimensions").get_to(r.dimensions);
    j.at("kernel").get_to(r.kernel);
    const auto errors = [](const nlohmann::ordered_json& from, Errors& e) {
        e.mse = number_or_nan(from, "mse");
        e.mse_raw = number_or_nan(from, "mse_raw");
        e.relmse = number_or_nan(from, "relmse");
        e.relmse_raw = number_or_nan(from, "relmse_raw");
        e.mae = number_or_nan(from, "mae");
        e.smape = number_or_nan(from, "smape");
        e.flip = number_or_nan(from, "flip");
    };
    errors(j, r.all);
    const nlohmann::ordered_json masked = j.value("masked", nlohmann::ordered_json::object());  // rows of older programs have none
    errors(masked, r.masked);
    r.masked.pixels = masked.value("pixels", std::int64_t{0});
    r.all.pixels = std::int64_t{r.crop[2]} * r.crop[3];
    r.fill = j.value("fill", "unstated");
    for (std::size_t i = 0; i < 3; ++i) r.mean_rgb[i] = j.at("mean_rgb").at(i);
    j.at("wall_seconds").get_to(r.wall_seconds);
    j.at("cpu_seconds").get_to(r.cpu_seconds);
    j.at("sampler_seconds").get_to(r.sampler_seconds);
    j.at("paths").get_to(r.paths);
    j.at("rays").get_to(r.rays);
    j.at("invalid_samples").get_to(r.invalid_samples);
    j.at("threads").get_to(r.threads);
    j.at("estimator_version").get_to(r.estimator_version);
    j.at("reference").get_to(r.reference);
    r.reference_content = j.value("reference_content", "");
    j.at("commit").get_to(r.commit);
    j.at("machine").get_to(r.machine);
    j.at("isa").get_to(r.isa);
}

}  // namespace koksma
