#pragma once
// MSE, RMSE and relMSE from replicates.
//
// Limits first. The replicate is the unit: pixels of one render are not replicates. The interval speaks of the spread between
// replicates; what the reference does to all of them alike (the cross term of its error with a bias, its variance being itself
// an estimate) is not in it. Rare events that no replicate met cannot be in it.
//
// Method: t on log(mean) with the delta method, the upper end widened for positive skewness (Hall 1992). Measured coverage of a
// nominal 95 %, in percent; in brackets that of a plain t interval. Reproduce: test_measure "[coverage]" -s
//
//   law of a replicate's error        R = 4        R = 8        R = 16
//   chi2-like, relative sd 0.02       95.9         95.6         95.6
//   chi2-like, relative sd 0.1        96.0         95.6         95.7
//   chi2-like, relative sd 0.25       96.3         95.7         95.7
//   chi2-like, relative sd 0.5        96.2         95.9         96.0
//   chi2-like, relative sd 1          95.7         96.2         96.5
//   lognormal, sigma 0.5              95.7 (91.6)  95.5 (92.0)  95.5 (92.8)
//   lognormal, sigma 1                93.7 (81.8)  93.8 (82.9)  94.7 (85.9)
//   Pareto, alpha 3                   89.6 (80.5)  91.1 (80.5)  92.8 (84.0)
//   Pareto, alpha 2.1                 87.4 (74.3)  89.1 (74.0)  90.8 (77.8)
//
// Two replicates are enough to cover 95 % of the chi2-like ones, with an interval too wide to be of use (t = 12.7).

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
