// What effects cost that nothing calls for.

#include "curve.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/statistics.h>

#include <algorithm>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// Seconds of each replicate over those of the same replicate with the needed effects: the two were rendered one after the other.
Estimate time_ratio(const Point& forced, const Point& needed) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(forced.cpu.size(), needed.cpu.size()); ++i)
        if (needed.cpu[i] > 0.0) ratios.push_back(forced.cpu[i] / needed.cpu[i]);
    return mean_estimate(ratios, kConfidence);
}

double ns_per_path(const Point& p) { return p.paths > 0 ? 1e9 * mean_estimate(p.cpu).value * static_cast<double>(p.cpu.size()) / static_cast<double>(p.paths) : 0.0; }

const Row* first_row(const std::vector<Row>& rows, const std::string& scene) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.scene == scene; });
    return found == rows.end() ? nullptr : &*found;
}

}  // namespace

Json effects_json(const std::vector<Row>& rows, const std::string& needed, const std::string& forced) {
    const Row *few = first_row(rows, needed), *many = first_row(rows, forced);
    if (few == nullptr || many == nullptr) return nullptr;
    std::vector<std::string> samplers;
    for (const Row& r : rows)
        if (r.scene == forced && std::find(samplers.begin(), samplers.end(), r.sampler) == samplers.end()) samplers.push_back(r.sampler);
    Json lines = Json::array();
    for (const std::string& sampler : samplers) {
        const Curve a = curve_of(rows, needed, sampler), b = curve_of(rows, forced, sampler);
        for (const auto& [spp, p] : b) {
            const auto at = a.find(spp);
            if (at == a.end()) continue;
            const Estimate time = time_ratio(p, at->second);
            // Above 1: the needed effects alone have the smaller error.
            const Gain error = gain(at->second.mse, p.mse, kConfidence);
            lines.push_back({{"sampler", sampler},
                             {"spp", spp},
                             {"ns_per_path_needed", ns_per_path(at->second)},
                             {"ns_per_path", ns_per_path(p)},
                             {"time_ratio", interval_json(time.value, time.lo, time.hi)},
                             {"mse_ratio", interval_json(error.value, error.lo, error.hi)},
                             {"distinguishable", error.distinguishable()}});
        }
    }
    return {{"needed", few->effects},
            {"forced", many->effects},
            {"dimensions_needed", few->dimensions},
            {"dimensions", many->dimensions},
            {"kernel_needed", few->kernel},
            {"kernel", many->kernel},
            {"lines", lines}};
}

}  // namespace koksma
