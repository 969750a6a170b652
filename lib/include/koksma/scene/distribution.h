#pragma once
// Discrete distributions by inversion: prefix sums in double, zero weights never chosen.

#include <koksma/sampling/bits.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace koksma {

/// What sampling a distribution gives: the index, its probability, and a fresh u in [0, 1) made of what is left of the old.
struct DiscreteSample {
    std::uint32_t index = 0;
    float probability = 0.0f;
    float u = 0.0f;
};

class DiscreteDistribution {
public:
    DiscreteDistribution() = default;
    /// @param weights  finite, >= 0, not all zero (an empty or zero distribution has total() == 0 and may not be sampled)
    explicit DiscreteDistribution(std::span<const double> weights) {
        cdf_.reserve(weights.size());
        double sum = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            sum += weights[i];
            cdf_.push_back(sum);
            if (weights[i] > 0.0) last_ = static_cast<std::uint32_t>(i);
        }
        total_ = sum;
        inv_total_ = sum > 0.0 ? 1.0 / sum : 0.0;
        if (cdf_.size() >= kGuided && sum > 0.0) make_guide();
    }
    [[nodiscard]] double total() const noexcept { return total_; }
    [[nodiscard]] std::size_t size() const noexcept { return cdf_.size(); }
    [[nodiscard]] float probability(std::uint32_t i) const noexcept {
        return static_cast<float>((cdf_[i] - (i == 0 ? 0.0 : cdf_[i - 1])) * inv_total_);
    }
    /// The first index whose prefix sum is above u * total: entries of weight zero are skipped at both ends and between.
    [[nodiscard]] DiscreteSample sample(float u) const noexcept {
        const double x = static_cast<double>(u) * total_;
        auto i = search(u, x);
        if (i > last_) i = last_;  // u * total may round up to the total
        const double below = i == 0 ? 0.0 : cdf_[i - 1];
        const double width = cdf_[i] - below;
        const auto rest = static_cast<float>((x - below) / width);
        return {i, static_cast<float>(width * inv_total_), rest < kOneMinusUlp ? (rest > 0.0f ? rest : 0.0f) : kOneMinusUlp};
    }

    /// What sampling reads, for kernels that do it side by side: prefix sums, the last index of positive weight, 1 / total().
    [[nodiscard]] std::span<const double> prefix_sums() const noexcept { return cdf_; }
    [[nodiscard]] std::uint32_t last() const noexcept { return last_; }
    [[nodiscard]] double inverse_total() const noexcept { return inv_total_; }

private:
    static constexpr std::size_t kGuided = 32;

    /// Where to look for the entries of each of n equal parts of [0, 1): sampling in constant time on average.
    /// Source: Chen and Asau 1974, "On generating random variates from an empirical distribution" (the guide table)
    void make_guide() {
        const std::size_t n = cdf_.size();
        guide_.resize(n + 1);
        std::size_t i = 0;
        for (std::size_t part = 0; part <= n; ++part) {
            const double x = static_cast<double>(part) / static_cast<double>(n) * total_;
            while (i < n && !(cdf_[i] > x)) ++i;
            guide_[part] = static_cast<std::uint32_t>(i);
        }
    }
    /// The first index whose prefix sum is above x = u * total.
    [[nodiscard]] std::uint32_t search(float u, double x) const noexcept {
        auto first = cdf_.begin(), last = cdf_.end();
        if (!guide_.empty()) {
            // One part more on both sides: the product may have rounded across the edge of a part.
            const std::size_t n = cdf_.size(), part = static_cast<std::size_t>(static_cast<double>(u) * static_cast<double>(n));
            last = first + std::min<std::size_t>(guide_[std::min(part + 2, n)] + 1, n);
            first += guide_[part > 0 ? part - 1 : 0];
        }
        return static_cast<std::uint32_t>(std::upper_bound(first, last, x) - cdf_.begin());
    }
    std::vector<std::uint32_t> guide_;
    std::vector<double> cdf_;
    double total_ = 0.0, inv_total_ = 0.0;
    std::uint32_t last_ = 0;
};

}  // namespace koksma
