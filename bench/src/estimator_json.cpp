#include "estimator_json.h"

#include <nlohmann/json.hpp>

namespace koksma {

nlohmann::ordered_json json_of(const EstimatorSettings& s) {
    return {{"light", name(s.light)},
            {"directions", name(s.direction)},
            {"end", text_of_end(s)},
            {"roulette_number", name(s.number)},
            {"branching", s.branching}};
}

nlohmann::ordered_json json_of(const Ledger& l) {
    const auto samples = static_cast<double>(l.samples);
    nlohmann::ordered_json invalid = nlohmann::ordered_json::array();
    for (const InvalidSample& i : l.invalid)
        invalid.push_back({{"kind", name(i.kind)}, {"pixel", {i.id.pixel.x, i.id.pixel.y}}, {"sample", i.id.index}});
    return {{"samples", l.samples},
            {"rays_closest", l.rays.closest},
            {"rays_shadow", l.rays.shadow},
            {"rays_per_sample", static_cast<double>(l.rays.closest + l.rays.shadow) / samples},
            {"vertices", l.vertices},
            {"truncated", {{"rays", l.truncated.rays}, {"weight", l.truncated.weight / samples}}},
            {"roulette",
             {{"played", l.roulette.played},
              {"lost", l.roulette.lost},
              {"weight_lost", l.roulette.weight_lost / samples},
              {"largest_boost", l.roulette.largest_boost},
              {"excess", l.roulette.excess / samples}}},
            {"invalid_samples", l.invalid_samples},
            {"invalid", invalid}};
}

}  // namespace koksma
