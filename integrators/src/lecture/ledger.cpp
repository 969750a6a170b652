#include <koksma/integrators/lecture/ledger.h>

#include <algorithm>

namespace koksma {

void Ledger::merge(const Ledger& later) {
    samples += later.samples;
    rays.closest += later.rays.closest;
    rays.shadow += later.rays.shadow;
    vertices += later.vertices;
    truncated.rays += later.truncated.rays;
    truncated.weight += later.truncated.weight;
    roulette.played += later.roulette.played;
    roulette.lost += later.roulette.lost;
    roulette.weight_lost += later.roulette.weight_lost;
    roulette.largest_boost = std::max(roulette.largest_boost, later.roulette.largest_boost);
    roulette.excess += later.roulette.excess;
    invalid_samples += later.invalid_samples;
    const std::size_t room = kMaxLocated - std::min(kMaxLocated, invalid.size());
    invalid.insert(invalid.end(), later.invalid.begin(),
                   later.invalid.begin() + static_cast<std::ptrdiff_t>(std::min(room, later.invalid.size())));
}

}  // namespace koksma
