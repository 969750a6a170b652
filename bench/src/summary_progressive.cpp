// The curve of a progressive render: one render to the end, read at every number of samples.

#include "curve.h"

#include <koksma/measure/rmse_estimate.h>
#include <koksma/measure/slope.h>

#include <cmath>

namespace koksma {

using Json = nlohmann::ordered_json;

Json progressive_json(const Curve& prefixes) {
    if (prefixes.empty()) return nullptr;
    const std::size_t renders = prefixes.begin()->second.mse.size();
    Json points = Json::array();
    std::vector<double> spps;
    std::vector<std::vector<double>> errors(renders);
    for (const auto& [spp, p] : prefixes) {
        const RmseEstimate e = rmse_estimate(p.mse, kConfidence);
        points.push_back({{"spp", spp}, {"rmse", number(e.rmse.value)}, {"lo", number(e.rmse.lo)}, {"hi", number(e.rmse.hi)}});
        if (spp == 1 || p.mse.size() != renders) continue;  // at 1 spp all randomised samplers are alike
        spps.push_back(static_cast<double>(spp));
        for (std::size_t k = 0; k < renders; ++k) errors[k].push_back(p.mse[k]);
    }
    Json slope;
    if (const SlopeFit fit = fit_prefix_slope(spps, errors, kConfidence); std::isfinite(fit.value)) {
        slope = interval_json(fit.value, fit.lo, fit.hi);
        slope["spp_from"] = static_cast<std::uint64_t>(fit.from);
        slope["spp_to"] = static_cast<std::uint64_t>(fit.to);
    }
    return {{"planned_spp", prefixes.rbegin()->first}, {"renders", renders}, {"points", points}, {"slope", slope}};
}

}  // namespace koksma
