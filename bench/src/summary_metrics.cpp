// Every metric of a point, over the crop and without visible emitters.

#include "curve.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/rmse_estimate.h>

#include <cmath>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

Json metric_json(const std::vector<double>& values, bool randomized) {
    const Estimate e = metric_estimate(replicates(values, randomized), kConfidence);
    return interval_json(e.value, e.lo, e.hi);
}

Json errors_json(const std::vector<Errors>& errors, bool randomized) {
    const RmseEstimate mse = rmse_estimate(replicates(values_of(errors, &Errors::mse), randomized), kConfidence);
    return {{"rmse", interval_json(mse.rmse.value, mse.rmse.lo, mse.rmse.hi)},
            {"relmse", metric_json(values_of(errors, &Errors::relmse), randomized)},
            {"mae", metric_json(values_of(errors, &Errors::mae), randomized)},
            {"smape", metric_json(values_of(errors, &Errors::smape), randomized)},
            {"flip", metric_json(values_of(errors, &Errors::flip), randomized)}};
}

}  // namespace

Json metrics_json(const Point& p, bool randomized, const Curve& baseline) {
    Json out = {{"all", errors_json(p.all, randomized)}, {"masked", errors_json(p.masked, randomized)}, {"masked_pixels", p.masked.front().pixels}};
    // Independent samples have an MSE of exactly variance / spp, so what random would need is no extrapolation.
    const auto at = baseline.find(p.spp);
    out["equivalent_random_spp"] = nullptr;
    if (at != baseline.end()) {
        const Gain g = gain(replicates(p.mse, randomized), at->second.mse, kConfidence);
        const auto spp = static_cast<double>(p.spp);
        if (std::isfinite(g.value)) out["equivalent_random_spp"] = interval_json(spp * g.value, spp * g.lo, spp * g.hi);
    }
    return out;
}

}  // namespace koksma
