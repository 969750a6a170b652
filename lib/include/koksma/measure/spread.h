#pragma once
// How much of a result is luck: errors of groups that differ only in a draw of ours (the layout of dimensions), each of them
// measured on replicates.
//
// Model: log RMSE of group k is mu + b_k + noise, b_k independent with one standard deviation, noise known from the replicates
// (delta method). Measured coverage of a nominal 95 % (8 groups of 8 replicates, MSE chi2-like with relative sd 0.1): at a spread
// of 0, 2, 5 and 20 %: test_measure "[spread]" -s prints it and holds it to 93 to 99.5 %.

#include <koksma/measure/statistics.h>

#include <span>
#include <vector>

namespace koksma {

struct Spread {
    double rmse = 0;         ///< geometric mean of the groups' RMSE
    double lowest = 0, highest = 0;  ///< of the groups' RMSE, with their noise in it
    /// Standard deviation between groups of log RMSE (0.1: about 10 %), noise of the replicates taken off; never negative. An interval
    /// that begins at 0 does not tell the groups apart.
    Estimate between;
    double p_equal = 0;      ///< how often equal groups would differ so much or more
    Estimate first;          ///< RMSE of `first` over `rmse`: is the default better than luck?
};

/// @param  first   corrected MSEs of the replicates of the group that is compared with the others, and is none of them
/// @param  groups  corrected MSEs of the replicates of each group; two groups of two replicates at least
/// @return         all NaN if a mean is not positive
/// @throws         Error for fewer groups or replicates, and if confidence is outside (0, 1)
/// Source: Williams 1962, "A confidence interval for variance components", Biometrika 49 (as Tukey 1951); the F test of one-way layouts
[[nodiscard]] Spread spread(std::span<const double> first, const std::vector<std::vector<double>>& groups, double confidence = 0.95);

}  // namespace koksma
