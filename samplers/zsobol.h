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

[[nodiscard]] constexpr std::uint64_t place_of(Pixel pixel) noexcept {
    return morton(static_cast<std::uint32_t>(pixel.x) & 0xffffu, static_cast<std::uint32_t>(pixel.y) & 0xffffu);
}

/// The permutations of {0, 1, 2, 3}, two bits an image, that of 0 in the lowest.
inline constexpr std::array<std::uint16_t, 24> kDigitPermutations = [] {
    std::array<std::uint16_t, 24> all{};
    std::size_t n = 0;
    for (unsigned a = 0; a < 4; ++a)
        for (unsigned b = 0; b < 4; ++b)
            for (unsigned c = 0; c < 4; ++c)
                if (a != b && a != c && b != c) all[n++] = static_cast<std::uint16_t>(a | (b << 2) | (c << 4) | ((6 - a - b - c) << 6));
    return all;
}();
/// Which of them, from a hash.
[[nodiscard]] constexpr std::uint32_t chosen_permutation(std::uint64_t hash) noexcept {
    return static_cast<std::uint32_t>(((hash >> 32) * kDigitPermutations.size()) >> 32);
}

/// The digits of a number that were permuted so far.
struct PermutedDigits {
    std::uint64_t above = 1;   ///< the digits before, after a leading 1 that tells the levels apart
    std::uint64_t images = 0;
    constexpr void add(unsigned digit, std::uint64_t key) noexcept {
        images = (images << 2) | ((kDigitPermutations[chosen_permutation(mix64(key ^ above))] >> (2 * digit)) & 3u);
        above = (above << 2) | digit;
    }
};

/// Permutes the base-4 digits of a number, each by one of the 24 permutations, chosen by a hash of the digits above it.
/// @param n     below 2^bits
/// @param bits  if odd, the last digit is one bit
/// @return      below 2^bits; a bijection for each key
[[nodiscard]] constexpr std::uint64_t permute_digits4(std::uint64_t n, int bits, std::uint64_t key) noexcept {
    PermutedDigits digits;
    int shift = bits;
    for (; shift >= 2;) {
        shift -= 2;
        digits.add(static_cast<unsigned>(n >> shift) & 3u, key);
    }
    return shift == 0 ? digits.images : (digits.images << 1) | ((n ^ (mix64(key ^ digits.above) >> 63)) & 1u);
}

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
        return {*this, (place_of(pixel) << sample_bits_) | sample};
    }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    int sample_bits_, bits_;
    Key order_key_, value_key_;
    bool owen_;
};

}  // namespace koksma
