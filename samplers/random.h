#pragma once
// random: independent uniform numbers, the baseline of every comparison.
// Source: counter-based generation as in Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3"; the
// counter is (seed, pixel, sample index, dimension), the mixer is keyed_hash (koksma/sampling/bits.h).

#include <koksma/sampling/sampler.h>

namespace koksma {

class RandomSampler {
public:
    struct Point {
        Key key;
        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return unit_float(keyed_hash(key, slot.dimension)); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            return {unit_float(keyed_hash(key, slot.dimension)), unit_float(keyed_hash(key, slot.dimension + 1))};
        }
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "random",
                .title = "Random",
                .paper = "Salmon et al. 2011, Parallel random numbers: as easy as 1, 2, 3"};
    }
    RandomSampler(const SamplerOptions&, const SamplingPlan& plan) noexcept : seed_(plan.seed) {}

    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        return {derive_key(pixel_key(seed_, pixel), index)};
    }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    std::uint64_t seed_;
};

}  // namespace koksma
