#pragma once
// zsobol: one two-dimensional Sobol' sequence along a Z-order curve of the pixels, its base-4 digits permuted for every slot.
// The error is that of padded Owen-scrambled Sobol' points in each pixel, but its sign is spread over neighbours.
// Source: Ahmed and Wonka 2020, "Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering of
// pixels", ACM Trans. Graph. 39(6). That the permutations depend on the seed is ours: replicates need it.

#include "film_bits.h"
#include "sobol_pair.h"

#include <koksma/sampling/owen_hash.h>

#include <array>

namespace koksma {

/// The place of a pixel along the Z-order curve: bits of x at even, of y at odd places.
[[nodiscard]] constexpr std::uint64_t morton(std::uint32_t x, std::uint32_t y) noexcept {
    const auto spread = [](std::uint64_t v) {
        v = (v | (v << 16)) & 0x0000ffff0000ffffull;
        v = (v | (v << 8)) & 0x00ff00ff00ff00ffull;
        v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0full;
        v = (v | (v << 2)) & 0x3333333333333333ull;
        return (v | (v << 1)) & 0x5555555555555555ull;
    };
    return spread(x) | (spread(y) << 1);
}

/// Permutes the base-4 digits of a number, each by one of the 24 permutations, chosen by a hash of the digits above it.
/// @param n     below 2^bits
/// @param bits  if odd, the last digit is one bit
/// @return      below 2^bits; a bijection for each key
[[nodiscard]] std::uint64_t permute_digits4(std::uint64_t n, int bits, std::uint64_t key) noexcept;

class ZSobolSampler {
public:
    class Point {
    public:
        Point(const ZSobolSampler& sampler, std::uint64_t place) noexcept : sampler_(&sampler), place_(place) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return value(index(slot), slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint64_t i = index(slot);
            return {value(i, slot.dimension), value(pascal_rev(i), slot.dimension + 1)};
        }

    private:
        [[nodiscard]] std::uint64_t index(const Slot& slot) const noexcept {
            return permute_digits4(place_, sampler_->bits_, join_key(derive_key(sampler_->order_key_, slot.dimension)));
        }
        [[nodiscard]] float value(std::uint64_t x_rev, std::uint32_t dimension) const noexcept {
            const std::uint32_t hash = keyed_hash(sampler_->value_key_, dimension);
            const auto digits = static_cast<std::uint32_t>(x_rev);
            return unit_float(reverse_bits(sampler_->owen_ ? owen_hash_rev(digits, hash) : digits ^ hash));
        }
        const ZSobolSampler* sampler_;
        std::uint64_t place_;
    };

    [[nodiscard]] static SamplerInfo info();
    ZSobolSampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// An index of spp or above falls on that of index mod 2^ceil(log2(spp)).
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        const std::uint64_t sample = index & ((std::uint64_t{1} << sample_bits_) - 1);
        return {*this, (morton(static_cast<std::uint32_t>(pixel.x) & 0xffffu, static_cast<std::uint32_t>(pixel.y) & 0xffffu) << sample_bits_) | sample};
    }

private:
    int sample_bits_, bits_;
    Key order_key_, value_key_;
    bool owen_;
};

}  // namespace koksma
