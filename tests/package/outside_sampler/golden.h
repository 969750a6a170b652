#pragma once
// golden: the golden-ratio sequence, a template for samplers that live outside Koksma's tree.
// Source: Weyl 1916; two dimensions: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (R2).
// Shuffled index: after Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4); the hash is that of Vegdahl 2021,
// "Building a better LK hash".

#include <koksma/sampling/sampler.h>

class GoldenSampler {
public:
    struct Point {
        koksma::Key key;
        std::uint32_t index;

        // 2^32 over the golden ratio; for pairs 2^32 / p and 2^32 / p^2, where p^3 = p + 1. All odd: no value occurs twice.
        [[nodiscard]] float get_1d(const koksma::Slot& slot) const noexcept { return value(slot, 0, 0x9e3779b9u); }
        [[nodiscard]] glm::vec2 get_2d(const koksma::Slot& slot) const noexcept {
            return {value(slot, 0, 0xc13fa9a9u), value(slot, 1, 0x91e10da5u)};
        }

        /// All slots walk along the same sequence; that each does so in an order of its own makes them independent of each other.
        [[nodiscard]] float value(const koksma::Slot& slot, std::uint32_t k, std::uint32_t alpha) const noexcept {
            const koksma::Key slot_key = derive_key(key, slot.dimension);
            const std::uint32_t shift = keyed_hash(slot_key, 1 + k);  // Cranley-Patterson
            return koksma::unit_float(shuffled(index, keyed_hash(slot_key, 0)) * alpha + shift);
        }
    };

    [[nodiscard]] static koksma::SamplerInfo info() {
        return {.name = "golden",
                .title = "Golden ratio",
                .paper = "Roberts 2018, The unreasonable effectiveness of quasirandom sequences",
                .joint = 2,
                .max_samples = std::uint64_t{1} << 32};
    }
    GoldenSampler(const koksma::SamplerOptions&, const koksma::SamplingPlan& plan) noexcept : seed_(plan.seed ^ 0x676f6c64656eull) {}

    [[nodiscard]] Point point(koksma::Pixel pixel, std::uint64_t index) const noexcept {
        return {pixel_key(seed_, pixel), static_cast<std::uint32_t>(index)};
    }

private:
    /// A bijection that maps aligned blocks of 16^m indices to aligned blocks: consecutive points, which is what the golden
    /// ratio spreads evenly, wherever they begin. Blocks of 2^m would keep neighbours together, and neighbours are correlated.
    [[nodiscard]] static std::uint32_t shuffled(std::uint32_t x, std::uint32_t seed) noexcept {
        x = koksma::reverse_bits(x);
        for (int round = 0; round < 2; ++round) {
            x ^= x * 0x3d20adeau;  // a Laine-Karras hash: every bit is changed by the bits below it
            x += seed;
            x *= (seed >> 16) | 1u;
            x ^= x * 0x05526c56u;
            x ^= x * 0x53a22864u;
            x ^= (x >> 2) & 0x33333333u;  // and by those above it within its four
            x ^= (x >> 1) & 0x77777777u;
        }
        return koksma::reverse_bits(x);
    }

    std::uint64_t seed_;
};
