#pragma once
// What a vectorised fill does with slots that no vectorised way is made for.

#include <koksma/sampling/sampler.h>

#include <cstddef>
#include <span>

namespace koksma {

/// One slot, one point after the other. Not inlined: compiled for any machine, whoever calls it.
template <class Sampler>
[[gnu::noinline]] void fill_points(const Sampler& sampler, std::span<const SampleId> samples, const Slot& slot, float* out, std::size_t stride) noexcept {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto point = sampler.point(samples[i].pixel, samples[i].index);
        if (slot.arity == 1) {
            out[i] = point.get_1d(slot);
        } else {
            const glm::vec2 u = point.get_2d(slot);
            out[i] = u.x, out[stride + i] = u.y;
        }
    }
}
/// A run of slots, one after the other.
template <class Sampler>
void fill_points(const Sampler& sampler, std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) noexcept {
    for (const Slot& slot : run) fill_points(sampler, samples, slot, out + (slot.dimension - run.front().dimension) * stride, stride);
}

}  // namespace koksma
