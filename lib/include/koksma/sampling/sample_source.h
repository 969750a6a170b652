#pragma once
// What an integrator sees of a sampler: one virtual call per batch.

#include <koksma/sampling/sampler.h>
#include <koksma/sampling/tail.h>

#include <cstddef>
#include <span>
#include <utility>

namespace koksma {

/// A sampler bound to a plan. Immutable, shared by all threads.
class SampleSource {
public:
    virtual ~SampleSource() = default;
    /// Draws a run of slots for a batch of samples.
    /// @param samples  any pixels and indices, in any order
    /// @param run      consecutive slots of the plan's layout
    /// @param out      out[d * stride + i] receives dimension (run.front().dimension + d) of samples[i]; all in [0, 1)
    /// @param stride   >= samples.size()
    virtual void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept = 0;
    /// The same values, one `point` after the other: the reference that a vectorised fill is held to.
    virtual void fill_scalar(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept { fill(samples, run, out, stride); }

    /// Whether the sampler brings a fill of its own.
    [[nodiscard]] bool vectorised() const noexcept { return vectorised_; }
    [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }
    /// The first dimension that is drawn from the tail because the sampler has no more.
    [[nodiscard]] std::uint32_t tail_dimension() const noexcept { return tail_dimension_; }

protected:
    SampleSource(std::uint64_t seed, std::uint32_t tail_dimension, bool vectorised = false) noexcept
        : seed_(seed), tail_dimension_(tail_dimension), vectorised_(vectorised) {}

private:
    std::uint64_t seed_;
    std::uint32_t tail_dimension_;
    bool vectorised_;
};

/// A sampler that brings its own (vectorised) fill; it must give the bits that `point` gives (held by a conformance test).
template <class T>
concept BatchSampler = Sampler<T> && requires(const T& t, std::span<const SampleId> s, SlotRun run, float* out, std::size_t stride) {
    { t.fill(s, run, out, stride) } noexcept;
};

/// Lifts an author's sampler to a SampleSource.
template <Sampler T>
class LiftedSource final : public SampleSource {
public:
    template <class... Tables>
    LiftedSource(const SamplerOptions& options, const SamplingPlan& plan, const Tables&... tables)
        : SampleSource(plan.seed, T::info().max_dimensions, BatchSampler<T>), sampler_(options, plan, tables...) {}

    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
        const SlotRun inside = before_tail(run);
        if constexpr (BatchSampler<T>)
            sampler_.fill(samples, inside, out, stride);
        else
            fill_points(samples, inside, out, stride);
        fill_tail(samples, run.subspan(inside.size()), out + dimension_count(inside) * stride, stride);
    }
    void fill_scalar(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
        const SlotRun inside = before_tail(run);
        fill_points(samples, inside, out, stride);
        fill_tail(samples, run.subspan(inside.size()), out + dimension_count(inside) * stride, stride);
    }

private:
    [[nodiscard]] SlotRun before_tail(SlotRun run) const noexcept {
        while (!run.empty() && run.back().dimension + run.back().arity > tail_dimension()) run = run.first(run.size() - 1);
        return run;
    }
    void fill_points(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const auto point = sampler_.point(samples[i].pixel, samples[i].index);
            for (const Slot& slot : run) {
                float* row = out + (slot.dimension - run.front().dimension) * stride + i;
                if (slot.arity == 1) {
                    *row = point.get_1d(slot);
                } else {
                    const glm::vec2 u = point.get_2d(slot);
                    row[0] = u.x;
                    row[stride] = u.y;
                }
            }
        }
    }
    void fill_tail(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
        for (const Slot& slot : run)
            for (std::uint32_t k = 0; k < slot.arity; ++k, out += stride)
                for (std::size_t i = 0; i < samples.size(); ++i)
                    out[i] = tail_sample(seed(), samples[i], slot.bounce, slot.role, k);
    }
    T sampler_;
};

}  // namespace koksma
