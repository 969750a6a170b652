#pragma once
// Do counts follow expected counts?

#include <cmath>
#include <cstddef>
#include <span>

namespace koksma::testing {

/// How far the chi-squared statistic is above its mean, in standard deviations of a normal variable. Bins that expect fewer
/// than 5 are pooled in order. Above 5 has a probability below 3e-7.
/// Source: Wilson and Hilferty 1931, "The distribution of chi-square", PNAS 17(12)
[[nodiscard]] inline double chi_squared_z(std::span<const double> counts, std::span<const double> expected) {
    double chi2 = 0, pooled_count = 0, pooled_expected = 0;
    int bins = 0;
    const auto close = [&] {
        chi2 += (pooled_count - pooled_expected) * (pooled_count - pooled_expected) / pooled_expected;
        ++bins;
        pooled_count = pooled_expected = 0;
    };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        pooled_count += counts[i];
        pooled_expected += expected[i];
        if (pooled_expected >= 5) close();
    }
    if (pooled_expected > 1e-3 * (pooled_count + 1)) close();
    const double k = bins - 1.0, v = 2.0 / (9.0 * k);
    return (std::cbrt(chi2 / k) - (1.0 - v)) / std::sqrt(v);
}

}  // namespace koksma::testing
