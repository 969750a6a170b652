#pragma once
// One path, numbers from two sources: some slots read a sequence, others another one, independent numbers or a constant.

#include <koksma/sampling/sample_source.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace koksma {

/// Which slots of a layout are meant, by their place in it.
using SlotSet = std::vector<bool>;

/// A source of which some slots read another source. Both are bound to the layout as it stands, so what a slot gets is what it would get
/// from either alone. Bounces beyond the layout draw from the tail of the first.
class MixedSource final : public SampleSource {
public:
    /// @param second        independent of `first` (another seed), or the mixture is no longer a uniform sample
    /// @param from_second   true: the slot reads `second`
    MixedSource(std::unique_ptr<SampleSource> first, std::unique_ptr<SampleSource> second, const DimensionLayout& layout,
                const SlotSet& from_second)
        : SampleSource(first->seed(), first->tail_dimension()),
          first_(std::move(first)),
          second_(std::move(second)),
          from_second_(layout.dimensions()) {
        for (std::size_t i = 0; i < from_second.size(); ++i) from_second_[layout.slots()[i].dimension] = from_second[i];
    }
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
        for (std::size_t begin = 0, end = 0; begin < run.size(); begin = end) {
            const bool second = from_second_[run[begin].dimension];
            while (end < run.size() && from_second_[run[end].dimension] == second) ++end;
            (second ? second_ : first_)
                ->fill(samples, run.subspan(begin, end - begin), out + (run[begin].dimension - run.front().dimension) * stride, stride);
        }
    }

private:
    std::unique_ptr<SampleSource> first_, second_;
    std::vector<bool> from_second_;  ///< by first dimension of the slot
};

/// The same number for every sample and dimension: 0.5 on the film is a ray through the pixel's centre.
class ConstantSource final : public SampleSource {
public:
    /// @param value  [0, 1)
    ConstantSource(float value, std::uint64_t seed) noexcept : SampleSource(seed, ~std::uint32_t{0}), value_(value) {}
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
        for (std::uint32_t d = 0; d < dimension_count(run); ++d)
            for (std::size_t i = 0; i < samples.size(); ++i) out[d * stride + i] = value_;
    }

private:
    float value_;
};

}  // namespace koksma
