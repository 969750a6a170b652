#pragma once
// Do replicates look like a law for which the intervals of koksma/measure were seen to cover less than they say?

#include <span>
#include <vector>

namespace koksma {

/// True where, at some point of a curve, one replicate exceeds kTailRatio times the mean of the others. Intervals of such curves were
/// seen to cover less than 93 % at a nominal 95 % in some cases (slope.h, ratio.h), because few replicates miss the rare large values.
/// How often it is said of curves of 5 points with 8 replicates each (test_measure "[tails]" -s): chi2-like with a relative sd of
/// 0.25, whose intervals cover: 0.3 %; 0.5, which cover too: 60 %; lognormal sigma 1: 100 %; Pareto alpha 3: 62 %; alpha 2.1: 90 %. So it warns of
/// some that do not fail, misses some that do, and of a curve with few replicates it knows little.
/// @param  points  the replicates of each point; those with fewer than 3, or with a mean of the others that is not positive, say nothing
[[nodiscard]] bool heavy_tailed(const std::vector<std::vector<double>>& points) noexcept;

inline constexpr double kTailRatio = 2.5;

/// The least coverage of nominal 95 % intervals that was seen under the heavy-tailed laws of test_measure "[coverage]", as fractions.
struct MeasuredCoverage {
    int replicates;  ///< for which it was measured: 4, 8 or 16
    double rmse, slope, gain;
};
/// @param replicates  of the point that has fewest; what lies between the measured numbers gets the smaller one's coverage
[[nodiscard]] MeasuredCoverage heavy_tailed_coverage(int replicates) noexcept;

}  // namespace koksma
