#pragma once
// The rate at which RMSE falls, with an interval.
//
// Limits first. The interval holds the noise of replicates, not the bend of the curve: where the error is not a power law over
// the window (a log factor, mixed classes of pixels, the floor of a reference) it covers the slope of the best line through the
// expected curve, and straight_p says that there is a bend. Points must be independent: native renders with disjoint seeds.
// Prefixes of one progressive render are not, and their interval is wrong. Leave 1 spp out: there all randomised samplers are
// alike. Points just above the floor are in the fit only if they came out positive, which makes them too high.
//
// Method: y = 0.5 log(mean MSE), weights by number of replicates (the relative variance being taken as the same everywhere), so the
// slope is a fixed sum of independent y; variances by the delta method from each point's own replicates, t with
// Welch-Satterthwaite degrees; the end on the side of net skewness widened (Hall 1992). Measured coverage of a nominal 95 %,
// in percent; reproduce: test_measure "[coverage]" -s
//
//   law of a replicate's error                     points  R = 4  R = 8  R = 16
//   chi2-like, relative sd 0.02                    2       95.8   95.3   95.7
//                                                  8       95.4   95.2   94.6
//   chi2-like, relative sd 0.5                     2       95.1   95.3   95.7
//                                                  8       95.2   94.3   95.4
//   0.02 in the lower half, 0.5 in the upper       8       95.7   95.5   95.3
//   lognormal, sigma 1                             6       90.7   91.5   92.0
//   Pareto, alpha 2.1                              6       92.2   91.4   93.0
//   chi2-like 0.1 in the lower half, Pareto above  6       86.3   88.6   90.4    (the fit looks too steep)

#include <span>
#include <vector>

namespace koksma {

/// The replicates at one number of samples.
struct RatePoint {
    double spp = 0;              ///< samples per pixel, or seconds: > 0
    std::vector<double> errors;  ///< one corrected MSE a replicate; singles may be negative
};

/// log RMSE = intercept + value * log spp.
struct SlopeFit {
    double value = 0;            ///< exponent of RMSE: -0.5 for independent samples; NaN if points < 2
    double lo = 0, hi = 0;       ///< confidence interval; NaN if no point has two replicates
    double intercept = 0;        ///< natural log of the RMSE at spp = 1 on the fitted line
    double standard_error = 0;   ///< of value
    double dof = 0;              ///< Welch-Satterthwaite degrees of freedom of the interval
    double straight_p = 0;       ///< p of an F test that the points lie on a line; NaN if points < 3 or nothing is known of the noise
    int points = 0;              ///< used
    int skipped = 0;             ///< left out: mean error not positive (below the reference's floor) or not finite
    double from = 0, to = 0;     ///< smallest and largest spp used: a slope without its window means nothing

    /// RMSE on the fitted line.
    [[nodiscard]] double rmse_at(double spp) const noexcept;
    [[nodiscard]] bool has_interval() const noexcept { return lo <= hi; }
};

/// Weighted least squares of y = 0.5 log(mean MSE) on log spp.
/// A point with a single replicate counts as one and borrows the pooled relative variance of the others.
/// @throws  Error if an spp is not finite and > 0 or confidence is outside (0, 1)
[[nodiscard]] SlopeFit fit_slope(std::span<const RatePoint> points, double confidence = 0.95);

}  // namespace koksma
