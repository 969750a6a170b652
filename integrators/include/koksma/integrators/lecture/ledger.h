#pragma once
// What an estimator's decisions cost: rays, and what truncation, roulette and invalid samples took.

#include <koksma/film/film.h>
#include <koksma/integrators/tracer.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace koksma {

/// Weights are those that the ray's radiance has in its camera sample: the mean of the throughput's three channels over branching^depth.
struct Ledger {
    std::uint64_t samples = 0;  ///< camera samples
    RayCounts rays;
    std::uint64_t vertices = 0;  ///< at which light was scattered

    /// Rays that were cut: by depth before the surface they meet reflects, by threshold before they are traced.
    struct Truncated {
        std::uint64_t rays = 0;
        double weight = 0.0;  ///< sum; per camera sample and times the radiance that was cut off, it is the bias
    } truncated;

    struct Roulette {
        std::uint64_t played = 0, lost = 0;
        double weight_lost = 0.0;    ///< sum over lost games, made up for by those that were won
        double largest_boost = 1.0;  ///< 1 / survival
        /// Sum of weight^2 (1 / survival - 1): per camera sample and times the square of the radiance beyond, the variance that roulette
        /// adds.
        double excess = 0.0;
    } roulette;

    std::uint64_t invalid_samples = 0;
    std::vector<InvalidSample> invalid;  ///< the first kMaxLocated in the order of tiles

    static constexpr std::size_t kMaxLocated = 64;
    /// Adds what came later. In a fixed order, the sums have the same bits.
    void merge(const Ledger& later);
};

}  // namespace koksma
