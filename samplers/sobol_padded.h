#pragma once
// sobol-padded: the first two dimensions of the Sobol' sequence, again and again. Each slot has an order and a scramble of its own.
// Source: Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4); Kollig and Keller 2002, "Efficient
// multidimensional sampling", for padding.

#include "index_shuffle.h"
#include "pixel_keys.h"
#include "sobol_pair.h"

namespace koksma {

class SobolPaddedSampler {
public:
    class Point {
    public:
        Point(Key pixel, std::uint64_t index) noexcept : orders_(derive_key(pixel, kPaddedOrders)), values_(pixel), index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            return value(static_cast<std::uint32_t>(shuffled_index(index_, orders_, slot.dimension)), slot.dimension);
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint64_t i = shuffled_index(index_, orders_, slot.dimension);
            return {value(static_cast<std::uint32_t>(i), slot.dimension), value(static_cast<std::uint32_t>(pascal_rev(i)), slot.dimension + 1)};
        }

    private:
        [[nodiscard]] float value(std::uint32_t x_rev, std::uint32_t dimension) const noexcept {
            return unit_float(reverse_bits(owen_hash_rev(x_rev, keyed_hash(values_, dimension))));
        }
        Key orders_, values_;
        std::uint64_t index_;
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "sobol-padded",
                .title = "Sobol', padded pairs",
                .paper = "Burley 2020, Practical hash-based Owen scrambling",
                .options = {{.name = "randomize",
                             .default_value = "owen",
                             .values = {"owen"},
                             .help = "index and values of each slot scrambled by a nested hash; without it all slots would be equal",
                             .always_shown = true},
                            pixels_option()},
                .joint = 2,
                .good_counts = {.rule = GoodCounts::Rule::power, .base = 2}};
    }
    SobolPaddedSampler(const SamplerOptions& options, const SamplingPlan& plan) : keys_(options, plan, 0x736f706164ull) {}

    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {keys_(pixel), index}; }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
};

}  // namespace koksma
