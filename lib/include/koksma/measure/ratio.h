#pragma once
// How much smaller the error of A is than that of B.
//
// Method: t on log(mean B) - log(mean A) with the delta method and Welch-Satterthwaite degrees; tails, skewness and outliers as in log_means.h.
// Measured coverage of a nominal 95 %, in percent; reproduce: test_measure "[coverage]" -s
//
//   laws of replicate errors of A, B          R = 4  R = 8  R = 16
//   chi2-like 0.02, 0.02 (relative sd)        96.0   95.9   96.4
//   chi2-like 0.02, 0.5                       95.8   95.6   95.2
//   chi2-like 0.25, 0.25                      95.9   95.8   95.9
//   chi2-like 0.5, 0.1                        94.9   95.5   95.5
//   chi2-like 0.5, 0.5                        95.6   95.8   96.0
//   chi2-like 1, the same                     95.5   96.4   96.6
//   lognormal sigma 1, the same               93.4   93.9   95.1
//   lognormal sigma 1, chi2-like 0.1          96.2   96.4   97.1
//   Pareto alpha 3, the same                  93.7   92.9   92.6
//   Pareto alpha 2.1, the same                93.1   92.3   92.8
//   Pareto alpha 2.1, chi2-like 0.1           87.0   91.3   94.2    (A, heavy-tailed, looks too good)
//
// One comparison at 95 % errs once in twenty: of many samplers on many scenes some are distinguishable by chance.

#include <span>
#include <vector>

namespace koksma {

/// Mean error of B over mean error of A: above 1, A is better. For MSE it reads "B needs this many times the samples" only
/// where the error falls as 1/spp.
struct Gain {
    double value = 0;
    double lo = 0, hi = 0;      ///< confidence interval; NaN if A or B has fewer than two replicates
    double dof = 0;             ///< Welch-Satterthwaite degrees of freedom
    bool below_floor = false;   ///< A's or B's mean error is not positive: all values NaN
    /// The interval excludes 1. False without an interval.
    [[nodiscard]] bool distinguishable() const noexcept { return lo > 1 || hi < 1; }
};

/// @param  a, b        one corrected MSE (or relMSE) a replicate, the two sets independent of each other
/// @param  confidence  (0, 1)
/// @throws             Error if confidence is outside (0, 1)
[[nodiscard]] Gain gain(std::span<const double> a, std::span<const double> b, double confidence = 0.95);

/// Two sets of replicates and the p of their means being equal.
struct Comparison {
    Gain gain;
    double p = 0;       ///< two-sided, of the interval's method: below 1 - confidence exactly where the interval excludes 1; NaN without one
    double p_holm = 0;  ///< adjusted by holm(); NaN where p is
    /// The family of comparisons errs with at most this probability. False where p_holm is NaN.
    [[nodiscard]] bool distinguishable(double alpha = 0.05) const noexcept { return p_holm < alpha; }
};
[[nodiscard]] Comparison compare_errors(std::span<const double> a, std::span<const double> b, double confidence = 0.95);

/// Sets p_holm of a family of comparisons: the i-th smallest p times (n - i), never less than a smaller p's. Those without a p do not count.
/// Source: Holm 1979, "A simple sequentially rejective multiple test procedure", Scandinavian Journal of Statistics 6(2)
void holm(std::vector<Comparison>& family);

/// The same where B was not measured at A's number of samples but below and above it: B's error there is taken to lie on a straight
/// line in log-log. The interval does not speak of how far it does not.
/// @param  weight  of `above`, (log n - log below) / (log above - log below), in [0, 1]
[[nodiscard]] Gain interpolated_gain(std::span<const double> a, std::span<const double> below, std::span<const double> above, double weight,
                                     double confidence = 0.95);

}  // namespace koksma
