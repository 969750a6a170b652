// Who is better than whom: within a scene with Holm's correction, across scenes without a claim about scenes that were not rendered.

#include "curve.h"

#include <koksma/measure/ratio.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// The largest spp that both have. 0: none
std::uint64_t common_spp(const Curve& a, const Curve& b) {
    for (auto it = a.rbegin(); it != a.rend(); ++it)
        if (b.contains(it->first)) return it->first;
    return 0;
}

}  // namespace

Json pairs_json(const std::vector<Contender>& contenders) {
    std::vector<Comparison> pairs;
    std::vector<Json> lines;
    for (std::size_t i = 0; i < contenders.size(); ++i)
        for (std::size_t k = i + 1; k < contenders.size(); ++k) {
            const Contender &a = contenders[i], &b = contenders[k];
            const std::uint64_t spp = common_spp(a.curve, b.curve);
            if (spp == 0 || !a.randomized || !b.randomized) continue;
            pairs.push_back(compare_errors(a.curve.at(spp).mse, b.curve.at(spp).mse, kConfidence));
            lines.push_back({{"a", a.sampler}, {"b", b.sampler}, {"spp", spp}});
            lines.back()["b_overtakes_below_ns_per_path"] = overtake_json(a, b, spp);
            lines.back()["a_overtakes_below_ns_per_path"] = overtake_json(b, a, spp);
        }
    holm(pairs);
    Json out = Json::array();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Comparison& c = pairs[i];
        lines[i]["mse_ratio"] = interval_json(c.gain.value, c.gain.lo, c.gain.hi);
        lines[i]["p"] = number(c.p);
        lines[i]["p_holm"] = number(c.p_holm);
        const bool tells = c.distinguishable(1 - kConfidence);
        lines[i]["better"] = !tells ? Json() : Json(c.gain.value > 1 ? lines[i]["a"] : lines[i]["b"]);
        lines[i]["verdict"] = c.gain.below_floor ? "below the reference's floor" : (tells ? "distinguishable" : "not distinguishable");
        out.push_back(lines[i]);
    }
    return out;
}

Json across_scenes_json(const std::vector<std::vector<Contender>>& scenes, const std::string& baseline) {
    std::vector<std::string> names;
    for (const auto& scene : scenes)
        for (const Contender& c : scene)
            if (c.sampler != baseline && std::find(names.begin(), names.end(), c.sampler) == names.end()) names.push_back(c.sampler);
    Json out = Json::array();
    for (const std::string& name : names) {
        double sum = 0, lowest = INFINITY, highest = 0;
        int counted = 0, left_out = 0;
        for (const auto& scene : scenes) {
            const auto at = [&](const std::string& sampler) { return std::find_if(scene.begin(), scene.end(), [&](const Contender& c) { return c.sampler == sampler; }); };
            const auto mine = at(name), base = at(baseline);
            if (mine == scene.end() || base == scene.end()) continue;
            const std::uint64_t spp = common_spp(mine->curve, base->curve);
            const Gain g = spp == 0 ? Gain{NAN, NAN, NAN, 0, true} : gain(replicates(mine->curve.at(spp).mse, mine->randomized), base->curve.at(spp).mse, kConfidence);
            if (!std::isfinite(g.value)) {
                ++left_out;
                continue;
            }
            sum += std::log(g.value);
            lowest = std::min(lowest, g.value);
            highest = std::max(highest, g.value);
            ++counted;
        }
        out.push_back({{"sampler", name},
                       {"scenes", counted},
                       {"left_out", left_out},
                       {"geometric_mean", number(counted > 0 ? std::exp(sum / counted) : NAN)},
                       {"lowest", number(counted > 0 ? lowest : NAN)},
                       {"highest", number(counted > 0 ? highest : NAN)}});
    }
    return out;
}

}  // namespace koksma
