#include "log_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace koksma {
namespace {

/// Skewness of the population, G1 = k_3 / k_2^1.5 with unbiased cumulants. 0 where it is not defined.
/// Source: Joanes and Gill 1998, "Comparing measures of sample skewness and kurtosis", The Statistician 47(1)
double sample_skewness(std::span<const double> x, const Moments& m) noexcept {
    if (m.n < 3 || !(m.variance > 0)) return 0;
    double cube = 0;
    for (const double v : x) cube += (v - m.mean) * (v - m.mean) * (v - m.mean);
    const double n = m.n;
    return n / ((n - 1) * (n - 2)) * cube / (m.variance * std::sqrt(m.variance));
}

/// (largest / mean of the others - 1 - log2(n) / 2) / 3, within [0, 1]: what is above 0 is rare for replicates whose relative sd is 0.5 or
/// less.
double outlier_of(std::span<const double> x) noexcept {
    if (x.size() < 3) return 0;
    const double largest = *std::max_element(x.begin(), x.end()), n = static_cast<double>(x.size());
    double sum = 0;
    for (const double v : x) sum += v;
    const double others = (sum - largest) / (n - 1);
    return others > 0 ? std::clamp((largest / others - 1 - std::log2(n) / 2) / 3, 0.0, 1.0) : 0;
}

/// The probability of missing upwards.
/// @param  up  share of the variance that comes from terms with positive coefficients
double tail_above(double up, double alpha) noexcept { return alpha * (1 - 1.445 * up + 0.53 * up * up); }

/// How many standard errors the true mean may be above the measured one, where a symmetric law says t.
/// Hall's g(T) = T + q T^2 / 3 + q^2 T^3 / 27 + q / 6 is near normal; this is -g^-1(-t).
double upward(double t, double q) noexcept {
    if (q < 1e-9) return t;  // the limit q -> 0, where the quotient loses its digits
    return std::max(t, 3 / q * (1 - std::cbrt(1 - q * t - q * q / 6)));
}

}  // namespace

LogMean log_mean(std::span<const double> replicates, const Moments& m) noexcept {
    return {std::log(m.mean), m.log_mean_variance(), static_cast<double>(m.n - 1),
            sample_skewness(replicates, m) / std::sqrt(static_cast<double>(m.n)), outlier_of(replicates)};
}

LogCombination combine(std::span<const double> c, std::span<const LogMean> terms, double confidence) {
    LogCombination r;
    std::vector<double> variances, dofs;
    double variance = 0, variance_up = 0, outlier = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        r.value += c[i] * terms[i].value;
        variances.push_back(c[i] * c[i] * terms[i].variance);
        dofs.push_back(terms[i].dof);
        variance += variances.back();
        if (c[i] > 0) variance_up += variances.back();
        if (terms.size() > 1) outlier = std::max(outlier, terms[i].outlier);
    }
    r.standard_error = std::sqrt(variance);
    const bool known = std::isfinite(variance);
    r.dof = known ? welch_satterthwaite(variances, dofs) : 0;
    (void)student_t_factor(confidence, 1);  // it checks the confidence
    if (!known) {
        r.lo = r.hi = r.standard_error = std::numeric_limits<double>::quiet_NaN();
        return r;
    }
    // Skewnesses add as third cumulants do, so terms of one shape and opposite sign cancel.
    double cumulant = 0;
    for (std::size_t i = 0; i < terms.size(); ++i)
        cumulant += (c[i] < 0 ? -1 : 1) * std::max(0.0, terms[i].skew) * variances[i] * std::sqrt(variances[i]);
    const double skew = variance > 0 ? cumulant / (variance * std::sqrt(variance)) : 0;
    const double up = variance > 0 ? variance_up / variance : 0.5, widened = 1 + 0.25 * outlier;
    const auto t = [&](double share) { return widened * std::max(0.0, student_t_quantile(1 - tail_above(share, 1 - confidence), r.dof)); };
    r.lo = r.value - upward(t(1 - up), -skew) * r.standard_error;
    r.hi = r.value + upward(t(up), skew) * r.standard_error;
    return r;
}

}  // namespace koksma
