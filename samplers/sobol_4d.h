#pragma once
// sobol-4d: the first four dimensions of the Sobol' sequence for each set of up to four dimensions of a vertex.
// Source: Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4); direction numbers of Joe and Kuo 2008.

#include "index_shuffle.h"
#include "joint_sets.h"
#include "pixel_keys.h"

#include <array>

namespace koksma {

/// Dimensions 0 to 3 of the Sobol' sequence: for every four digits of the index, the xor of the columns that each of their
/// 16 values selects, bit-reversed. [dimension][nibble of the index][its value]; 16 nibbles are 64 columns.
using Sobol4Table = std::array<std::array<std::array<std::uint32_t, 16>, 16>, 4>;

namespace detail {
[[nodiscard]] constexpr Sobol4Table make_sobol4() {
    // Degree of the primitive polynomial, its inner coefficients, and the initial numbers m: new-joe-kuo-6, dimensions 2 to 4.
    struct Dimension {
        std::uint32_t degree, polynomial, m[3];
    };
    constexpr Dimension kJoeKuo[3] = {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};
    Sobol4Table table{};
    for (std::size_t d = 0; d < 4; ++d) {
        std::array<std::uint32_t, 64> v{};  // as sobol.cpp: the leading 32 digits of 64 columns
        for (std::uint32_t c = 0; c < 64; ++c) {
            if (d == 0) {
                v[c] = c < 32 ? 0x80000000u >> c : 0;
                continue;
            }
            const Dimension& p = kJoeKuo[d - 1];
            if (c < p.degree) {
                v[c] = p.m[c] << (31 - c);
                continue;
            }
            v[c] = v[c - p.degree] ^ (v[c - p.degree] >> p.degree);
            for (std::uint32_t k = 1; k < p.degree; ++k)
                if ((p.polynomial >> (p.degree - 1 - k)) & 1u) v[c] ^= v[c - k];
        }
        for (std::size_t nibble = 0; nibble < 16; ++nibble)
            for (std::size_t value = 0; value < 16; ++value)
                for (std::size_t bit = 0; bit < 4; ++bit)
                    if ((value >> bit) & 1u) table[d][nibble][value] ^= reverse_bits(v[4 * nibble + bit]);
    }
    return table;
}
}  // namespace detail

inline constexpr Sobol4Table kSobol4 = detail::make_sobol4();

/// Coordinate of a point of the Sobol' sequence, unscrambled and bit-reversed.
/// @param dimension  below 4
[[nodiscard]] constexpr std::uint32_t sobol4_rev(std::uint64_t index, std::uint32_t dimension) noexcept {
    std::uint32_t x = 0;
    for (std::size_t nibble = 0; index != 0; index >>= 4, ++nibble) x ^= kSobol4[dimension][nibble][index & 15u];
    return x;
}

class Sobol4DSampler {
public:
    class Point {
    public:
        Point(const JointPlace* places, Key pixel, std::uint64_t index) noexcept
            : places_(places), orders_(derive_key(pixel, kPaddedOrders)), values_(pixel), index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            const JointPlace place = places_[slot.dimension];
            return value(shuffled_index(index_, orders_, place.set), place.within, slot.dimension);
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const JointPlace place = places_[slot.dimension];
            const std::uint64_t i = shuffled_index(index_, orders_, place.set);
            return {value(i, place.within, slot.dimension), value(i, place.within + 1, slot.dimension + 1)};
        }

    private:
        [[nodiscard]] float value(std::uint64_t i, std::uint32_t within, std::uint32_t dimension) const noexcept {
            return unit_float(reverse_bits(owen_hash_rev(sobol4_rev(i, within), keyed_hash(values_, dimension))));
        }
        const JointPlace* places_;
        Key orders_, values_;
        std::uint64_t index_;
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "sobol-4d",
                .title = "Sobol', padded sets of four",
                .paper = "Burley 2020, Practical hash-based Owen scrambling",
                .options = {{.name = "randomize",
                             .default_value = "owen",
                             .values = {"owen"},
                             .help = "index and values of each set scrambled by a nested hash; without it all sets would be equal",
                             .always_shown = true},
                            pixels_option()},
                .joint = 4,
                .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
                .remark = "a set is up to four dimensions of consecutive slots of the camera or of one bounce"};
    }
    Sobol4DSampler(const SamplerOptions& options, const SamplingPlan& plan)
        : keys_(options, plan, 0x736f626f6c3464ull), places_(joint_sets(plan.layout, 4, true)) {}

    /// @note  draws the slots of the plan's layout only
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {places_.data(), keys_(pixel), index}; }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    std::vector<JointPlace> places_;
};

}  // namespace koksma
