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
// Welch-Satterthwaite degrees; tails, skewness and outliers as in log_means.h. Measured coverage of a nominal 95 %,
// in percent; reproduce: test_measure "[coverage]" -s
//
//   law of a replicate's error                     points  R = 4  R = 8  R = 16
//   chi2-like, relative sd 0.02                    2       96.0   95.9   96.6
//                                                  8       96.0   96.2   95.5
//   chi2-like, relative sd 0.5                     2       95.3   95.8   96.5
//                                                  8       96.5   95.7   96.2
//   0.02 in the lower half, 0.5 in the upper       8       96.5   95.5   95.6
//   chi2-like, relative sd 1                       6       96.8   97.6   98.0
//   lognormal, sigma 1                             6       95.0   95.3   96.5
//   Pareto, alpha 3                                6       92.7   92.8   94.2
//   Pareto, alpha 2.1                              6       92.4   92.8   95.0
//   chi2-like 0.1 in the lower half, lognormal 1   6       96.6   97.8   98.5
//   chi2-like 0.1 in the lower half, Pareto 2.1    6       91.4   94.0   95.7    (the fit looks too steep)
//
// Prefixes of a progressive render (fit_prefix_slope), chi2-like 0.02 to 0.25, 4 points: 94.6 to 95.4.

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

/// The slope of a progressive curve: prefixes of one and the same renders, so points depend on each other and only whole renders do not.
/// Weighted as fit_slope does it; the interval is of the jackknife that leaves out one render at a time, t with R - 1 degrees.
/// @param  spp     > 0, of each prefix
/// @param  errors  corrected MSEs, one list a render, each as long as spp
/// @return         NaN where a mean is not positive; no interval with fewer than two renders. straight_p is NaN: the F test knows
/// independent points only
/// @throws         Error if a list has another length, and as fit_slope
/// Source: Tukey 1958, "Bias and confidence in not-quite large samples"; Efron 1982, "The Jackknife, the Bootstrap and Other Resampling
/// Plans"
[[nodiscard]] SlopeFit fit_prefix_slope(std::span<const double> spp, const std::vector<std::vector<double>>& errors,
                                        double confidence = 0.95);

}  // namespace koksma
