#pragma once
// The few statistics that the checks need, all as a number of standard deviations.

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace koksma::conformance {

/// A histogram that should be flat.
class Histogram {
public:
    explicit Histogram(std::size_t bins) : counts_(bins, 0.0) {}
    void add(std::size_t bin) noexcept { counts_[bin] += 1; }
    /// How far the chi-squared statistic is above its mean, in standard deviations of a normal variable.
    /// Source: Wilson and Hilferty 1931, "The distribution of chi-square", PNAS 17(12); at 63 degrees of freedom a
    /// threshold of 6 is a probability of about 2e-9.
    [[nodiscard]] double z() const {
        double total = 0;
        for (const double c : counts_) total += c;
        const double expected = total / static_cast<double>(counts_.size());
        double chi2 = 0;
        for (const double c : counts_) chi2 += (c - expected) * (c - expected) / expected;
        const double k = static_cast<double>(counts_.size() - 1), v = 2 / (9 * k);
        return (std::cbrt(chi2 / k) - (1 - v)) / std::sqrt(v);
    }

private:
    std::vector<double> counts_;
};

/// The mean in units of its standard error. Zero if all values are equal to within 1e-9 and so is their mean to zero.
inline double mean_z(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    double mean = 0, square = 0;
    for (const double v : values) mean += v / n;
    for (const double v : values) square += (v - mean) * (v - mean) / n;
    if (std::abs(mean) < 1e-7 && square < 1e-14) return 0;
    return mean / std::sqrt(square / (n - 1));
}

/// The correlation of two series about zero, times sqrt(n): standard normal if they are independent with mean zero.
inline double correlation_z(std::span<const double> a, std::span<const double> b) {
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += a[i] * b[i];
        aa += a[i] * a[i];
        bb += b[i] * b[i];
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) * std::sqrt(static_cast<double>(a.size())) : 0;
}

}  // namespace koksma::conformance
