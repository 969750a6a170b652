// Error against time: efficiency, equal time, and where a slower sampler would overtake.

#include "curve.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/rmse_estimate.h>

#include <algorithm>
#include <cmath>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

double seconds(const Point& p) { return mean_estimate(p.cpu).value; }

/// MSE of a curve at so many seconds, on a straight line in log-log between its points. NaN outside them.
double mse_at(const Curve& curve, double at) {
    const Point* below = nullptr;
    for (const auto& [spp, p] : curve) {
        const double s = seconds(p);
        const double mse = moments(p.mse).mean;
        if (!(mse > 0 && s > 0)) continue;
        if (below != nullptr && seconds(*below) <= at && at <= s) {
            const double from = seconds(*below), part = s > from ? std::log(at / from) / std::log(s / from) : 1;
            const double mse_below = moments(below->mse).mean;
            return mse_below * std::pow(mse / mse_below, part);
        }
        below = &p;
    }
    return NAN;
}

}  // namespace

Json efficiency_json(const Point& p, bool randomized) {
    const Estimate mse = metric_estimate(replicates(p.mse, randomized), kConfidence);
    const double s = seconds(p);
    return interval_json(1 / (mse.value * s), 1 / (mse.hi * s), 1 / (mse.lo * s));
}

Json equal_time_json(const Curve& curve, const Curve& baseline) {
    // At the longest time that both were measured within.
    double latest[2] = {0, 0};
    const Curve* curves[] = {&curve, &baseline};
    for (int i = 0; i < 2; ++i)
        for (const auto& [spp, p] : *curves[i]) latest[i] = std::max(latest[i], seconds(p));
    const double at = std::min(latest[0], latest[1]);
    const double mine = mse_at(curve, at), other = mse_at(baseline, at);
    if (!std::isfinite(mine) || !std::isfinite(other)) return nullptr;
    return {{"seconds", at}, {"mse_ratio", other / mine}, {"how", "interpolated"}};
}

Json overtake_json(const Contender& first, const Contender& second, std::uint64_t spp) {
    const Point &a = first.curve.at(spp), &b = second.curve.at(spp);
    const double mse_a = moments(a.mse).mean, mse_b = moments(b.mse).mean;
    if (!(mse_a > 0 && mse_b > 0) || a.paths == 0) return nullptr;
    // The efficiency 1 / (MSE x seconds) of B is that of A when a path of B costs cost_a * mse_a / mse_b.
    const double ns_a = 1e9 * seconds(a) / static_cast<double>(a.paths), ns_b = 1e9 * seconds(b) / static_cast<double>(b.paths);
    const Gain g = gain(replicates(b.mse, second.randomized), replicates(a.mse, first.randomized), kConfidence);
    Json out = interval_json(ns_a * g.value, ns_a * g.lo, ns_a * g.hi);
    out["ns_a"] = ns_a;
    out["ns_b"] = ns_b;
    return out;
}

}  // namespace koksma
