#pragma once
// MSE, RMSE and relMSE from replicates.
//
// Limits first. The replicate is the unit: pixels of one render are not replicates. The interval speaks of the spread between
// replicates; what the reference does to all of them alike (the cross term of its error with a bias, its variance being itself
// an estimate) is not in it. Rare events that no replicate met cannot be in it.
//
// Method: t on log(mean) with the delta method and unequal tails, 5 % below and 0.4 % above, and the upper end widened for positive
// skewness (log_means.h). Measured coverage of a nominal 95 %, in percent; in brackets that of a plain t
// interval. Reproduce: test_measure "[coverage]" -s; docs/intervals.md has what else was tried
//
//   law of a replicate's error        R = 4        R = 8        R = 16
//   chi2-like, relative sd 0.02       94.8         94.6         94.9
//   chi2-like, relative sd 0.1        95.1         94.9         94.9
//   chi2-like, relative sd 0.25       95.6         95.2         95.1
//   chi2-like, relative sd 0.5        96.2 (93.3)  95.5 (93.6)  95.5 (94.4)
//   chi2-like, relative sd 1          96.5 (87.8)  96.0 (89.5)  95.7 (91.6)
//   lognormal, sigma 0.5              96.6 (91.6)  96.4 (92.0)  96.0 (92.8)
//   lognormal, sigma 1                96.8 (81.8)  95.9 (82.9)  96.1 (85.9)
//   Pareto, alpha 3                   94.9 (80.5)  95.7 (80.5)  96.6 (84.0)
//   Pareto, alpha 2.1                 93.7 (74.3)  94.4 (74.0)  95.6 (77.8)
//
// Two replicates are enough to cover 95 % of the chi2-like ones, with an interval too wide to be of use (its upper end is e^(75 standard errors)).

#include <koksma/measure/statistics.h>

namespace koksma {

/// A mean squared error and its root.
struct RmseEstimate {
    Estimate mse;              ///< mean over replicates; NaN if below_floor
    Estimate rmse;             ///< root of the mean MSE (not the mean of roots), interval likewise; NaN if below_floor
    bool below_floor = false;  ///< the corrected error is not above the floor: it cannot be told from the reference's own noise
    double mean_mse = 0;       ///< the corrected mean as it came out, also when negative; for the record, not for a plot
};

/// A positive error metric (MSE, relMSE; corrected for the reference's noise, so single replicates may be negative).
/// @param  replicates  one value a replicate
/// @param  confidence  (0, 1)
/// @param  floor       value is NaN and the interval with it if the mean is not above this
/// @throws             Error if confidence is outside (0, 1)
[[nodiscard]] Estimate metric_estimate(std::span<const double> replicates, double confidence = 0.95, double floor = 0);

/// The same with its root.
[[nodiscard]] RmseEstimate rmse_estimate(std::span<const double> mse_replicates, double confidence = 0.95, double floor = 0);

}  // namespace koksma
