#pragma once
// The few statistics that the checks need, all as a number of standard deviations.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace koksma::conformance {

/// How far a chi-squared statistic with k degrees of freedom is above its mean, in standard deviations of a normal variable.
/// Source: Wilson and Hilferty 1931, "The distribution of chi-square", PNAS 17(12); at 63 degrees of freedom a
/// threshold of 6 is a probability of about 2e-9.
inline double chi2_z(double chi2, double k) {
    const double v = 2 / (9 * k);
    return (std::cbrt(chi2 / k) - (1 - v)) / std::sqrt(v);
}

/// A histogram that should be flat.
class Histogram {
public:
    explicit Histogram(std::size_t bins) : counts_(bins, 0.0) {}
    void add(std::size_t bin) noexcept { counts_[bin] += 1; }
    /// See chi2_z.
    [[nodiscard]] double z() const {
        double total = 0;
        for (const double c : counts_) total += c;
        const double expected = total / static_cast<double>(counts_.size());
        double chi2 = 0;
        for (const double c : counts_) chi2 += (c - expected) * (c - expected) / expected;
        return chi2_z(chi2, static_cast<double>(counts_.size() - 1));
    }

private:
    std::vector<double> counts_;
};

/// Counts of pairs whose two parts should be independent.
class Table {
public:
    explicit Table(std::size_t side) : side_(side), counts_(side * side, 0.0) {}
    void add(std::size_t row, std::size_t column) noexcept { counts_[row * side_ + column] += 1; }
    /// See chi2_z. Rows and columns with less than 1/24 of all are counted with the fullest one, so that with 4096 pairs every cell
    /// expects 7 or more, as the statistic wants. A table of one row or column is independent.
    [[nodiscard]] double z() const {
        std::vector<double> rows(side_, 0.0), columns(side_, 0.0);
        double total = 0;
        for (std::size_t k = 0; k < counts_.size(); ++k) rows[k / side_] += counts_[k], columns[k % side_] += counts_[k], total += counts_[k];
        const std::vector<std::size_t> row_of = merged(rows, total / 24), column_of = merged(columns, total / 24);
        std::vector<double> count(counts_.size(), 0.0);
        for (std::size_t k = 0; k < counts_.size(); ++k) count[row_of[k / side_] * side_ + column_of[k % side_]] += counts_[k];
        double chi2 = 0, filled_rows = 0, filled_columns = 0;
        for (std::size_t k = 0; k < side_; ++k) filled_rows += rows[k] > 0, filled_columns += columns[k] > 0;
        if (filled_rows < 2 || filled_columns < 2) return 0;
        for (std::size_t k = 0; k < count.size(); ++k) {
            const double expected = rows[k / side_] * columns[k % side_] / total;
            if (expected > 0) chi2 += (count[k] - expected) * (count[k] - expected) / expected;
        }
        return chi2_z(chi2, (filled_rows - 1) * (filled_columns - 1));
    }

private:
    /// Moves sums below `least` to the largest one. @return where each went
    static std::vector<std::size_t> merged(std::vector<double>& sums, double least) {
        const auto fullest = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
        std::vector<std::size_t> to(sums.size());
        for (std::size_t k = 0; k < sums.size(); ++k) {
            to[k] = k != fullest && sums[k] < least ? fullest : k;
            if (to[k] == k) continue;
            sums[fullest] += sums[k];
            sums[k] = 0;
        }
        return to;
    }
    std::size_t side_;
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
