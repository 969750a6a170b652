#pragma once
// Intervals for sums of logarithms of means: the one method behind metric_estimate, fit_slope and gain.

#include <koksma/measure/statistics.h>

#include <span>

namespace koksma {

/// The logarithm of the mean of positive-mean replicates, and what is known of its error.
struct LogMean {
    double value = 0;     ///< log(mean)
    double variance = 0;  ///< delta method: s^2 / (n mean^2)
    double dof = 0;       ///< of the variance: n - 1
    double skew = 0;      ///< of the replicates divided by sqrt(n); 0 if n < 3
    double outlier = 0;   ///< in [0, 1]: how far the largest replicate stands above the others; 0 if n < 3
};

/// @pre the mean is > 0; variance and dof are NaN and 0 if n < 2
[[nodiscard]] LogMean log_mean(std::span<const double> replicates, const Moments& m) noexcept;

/// c_1 log(mean_1) + ... + c_k log(mean_k), with independent terms.
struct LogCombination {
    double value = 0, lo = 0, hi = 0;
    double standard_error = 0;
    double dof = 0;
};

/// t interval with Welch-Satterthwaite degrees, made for means of skewed positive numbers: few replicates miss the rare large values, so a
/// mean is too small far more often than too large, and its standard error with it. Three things follow.
/// * The tails are unequal. Where all of the variance comes from terms with c > 0, the end above has 0.085 of 1 - confidence and the one
/// below all
///   of it; where none does, the other way round; half and half, 0.41 each.
/// * Towards larger means each term's t is widened for its skewness, if positive.
/// * A combination of several terms is widened by up to a quarter where one replicate stands far above the others of its term.
/// The numbers are calibrated by simulation: test_measure "[coverage]" holds what comes of them.
/// @param  c      coefficients, as many as terms
/// @throws        Error if confidence is outside (0, 1)
/// Source of the widening: Hall 1992, "On the removal of skewness by transformation", JRSS B 54(1), the cubic transformation
[[nodiscard]] LogCombination combine(std::span<const double> c, std::span<const LogMean> terms, double confidence);

}  // namespace koksma
