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

/// The last point of a curve whose mean error is positive; nullptr: none.
const Point* last_point(const Curve& curve) {
    for (auto it = curve.rbegin(); it != curve.rend(); ++it)
        if (moments(it->second.mse).mean > 0 && seconds(it->second) > 0) return &it->second;
    return nullptr;
}

/// MSE of a curve at the end of another, by that end's MSE; on a straight line in log-log between the curve's points. NaN outside them.
Gain gain_at_end(const Curve& curve, bool randomized, const Point& end, bool end_randomized) {
    const Point* below = nullptr;
    for (const auto& [spp, p] : curve) {
        if (!(moments(p.mse).mean > 0 && seconds(p) > 0)) continue;
        const double at = seconds(end), to = seconds(p), from = below != nullptr ? seconds(*below) : NAN;
        if (from <= at && at <= to) {
            const double part = to > from ? std::log(at / from) / std::log(to / from) : 1;
            return interpolated_gain(replicates(end.mse, end_randomized), replicates(below->mse, randomized), replicates(p.mse, randomized), part, kConfidence);
        }
        below = &p;
    }
    return {NAN, NAN, NAN, 0, false};
}

}  // namespace

Json efficiency_json(const Point& p, bool randomized) {
    const Estimate mse = metric_estimate(replicates(p.mse, randomized), kConfidence);
    const double s = seconds(p);
    return interval_json(1 / (mse.value * s), 1 / (mse.hi * s), 1 / (mse.lo * s));
}

Json equal_time_json(const Curve& curve, bool randomized, const Curve& baseline) {
    // At the longest time that both were measured within: the end of one of them.
    const Point *mine = last_point(curve), *other = last_point(baseline);
    if (mine == nullptr || other == nullptr) return nullptr;
    const bool mine_ends_first = seconds(*mine) <= seconds(*other);
    Gain g = mine_ends_first ? gain_at_end(baseline, true, *mine, randomized) : gain_at_end(curve, randomized, *other, true);
    if (!mine_ends_first) g = {1 / g.value, 1 / g.hi, 1 / g.lo, g.dof, false};
    if (!std::isfinite(g.value)) return nullptr;
    return {{"seconds", seconds(mine_ends_first ? *mine : *other)}, {"mse_ratio", number(g.value)}, {"lo", number(g.lo)}, {"hi", number(g.hi)}, {"how", "interpolated"}};
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
