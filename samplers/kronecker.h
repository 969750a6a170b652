#pragma once
// kronecker: multiples of an irrational, modulo 1: R1 in 1-D slots, R2 in 2-D slots, each slot in an order of its own.
// Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (extremelearning.com.au); Kronecker 1884;
// cp: Cranley and Patterson 1976.

#include "index_shuffle.h"
#include "pixel_keys.h"

namespace koksma {

/// Steps as 64-bit binary fractions, the nearest odd ones: no value comes twice within 2^64 samples.
inline constexpr std::uint64_t kR1 = 0x9e3779b97f4a7c15ull;   ///< 1 / phi, phi^2 = phi + 1
inline constexpr std::uint64_t kR2x = 0xc13fa9a902a6328full;  ///< 1 / g, g^3 = g + 1
inline constexpr std::uint64_t kR2y = 0x91e10da5c79e7b1dull;  ///< 1 / g^2

/// frac(1/2 + index * step): its 32 leading digits; the 64-bit product wraps as frac does. The start is Roberts'.
[[nodiscard]] constexpr std::uint32_t kronecker_bits(std::uint64_t index, std::uint64_t step) noexcept {
    return static_cast<std::uint32_t>((index * step + 0x8000000000000000ull) >> 32);
}

class KroneckerSampler {
public:
    class Point {
    public:
        Point(Key pixel, std::uint64_t index, bool randomized) noexcept
            : orders_(derive_key(pixel, kPaddedOrders)), shifts_(pixel), index_(index), randomized_(randomized) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return value(place(slot.dimension), kR1, slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint64_t i = place(slot.dimension);
            return {value(i, kR2x, slot.dimension), value(i, kR2y, slot.dimension + 1)};
        }

    private:
        /// Unrandomised, the first slot is the sequence itself.
        [[nodiscard]] std::uint64_t place(std::uint32_t dimension) const noexcept {
            return randomized_ || dimension != 0 ? shuffled_index(index_, orders_, dimension) : index_;
        }
        [[nodiscard]] float value(std::uint64_t i, std::uint64_t step, std::uint32_t dimension) const noexcept {
            return unit_float(kronecker_bits(i, step) + (randomized_ ? keyed_hash(shifts_, dimension) : 0u));
        }
        Key orders_, shifts_;
        std::uint64_t index_;
        bool randomized_;
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "kronecker",
                .title = "Kronecker (R1, R2)",
                .paper = "Roberts 2018, The unreasonable effectiveness of quasirandom sequences",
                .options = {{.name = "randomize",
                             .default_value = "cp",
                             .values = {"none", "cp"},
                             .help = "a fixed order for each slot, or a random order and a shift modulo 1",
                             .always_shown = true},
                            pixels_option()},
                .joint = 2,
                .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
                .remark = "powers of 2 because of the shuffled order of the slots; the sequence itself has no bad count"};
    }
    KroneckerSampler(const SamplerOptions& options, const SamplingPlan& plan)
        : keys_(options, plan, 0x6b726f6eull), randomized_(options["randomize"] == "cp") {}

    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        return {randomized_ ? keys_(pixel) : Key{}, index, randomized_};
    }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    bool randomized_;
};

}  // namespace koksma
