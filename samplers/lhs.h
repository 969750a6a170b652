#pragma once
// lhs: Latin hypercubes. Every dimension is stratified in spp intervals, no two dimensions are stratified together.
// Source: McKay, Beckman and Conover 1979, "A comparison of three methods for selecting values of input variables in the
// analysis of output from a computer code", Technometrics 21(2).

#include "permutation.h"
#include "pixel_keys.h"
#include "stratum.h"

#include <algorithm>

namespace koksma {

class LhsSampler {
    static constexpr std::uint64_t kOrderKeys = ~std::uint64_t{0};  ///< a counter that no sample index takes

public:
    class Point {
    public:
        Point(const LhsSampler& sampler, Key pixel, std::uint64_t index) noexcept
            : sampler_(&sampler), orders_(derive_key(pixel, kOrderKeys)), jitter_(derive_key(pixel, index)),
              index_(static_cast<std::uint32_t>(index < sampler.count_ ? index : index % sampler.count_)) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return value(slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept { return {value(slot.dimension), value(slot.dimension + 1)}; }

    private:
        [[nodiscard]] float value(std::uint32_t dimension) const noexcept {
            const std::uint32_t stratum = permute(index_, sampler_->count_, derive_key(orders_, dimension));
            return stratum_float(stratum, sampler_->count_, sampler_->scale_, keyed_hash(jitter_, dimension) * 0x1p-32);
        }

        const LhsSampler* sampler_;
        Key orders_, jitter_;
        std::uint32_t index_;
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "lhs",
                .title = "Latin hypercube",
                .paper = "McKay, Beckman and Conover 1979, A comparison of three methods for selecting values of input variables",
                .options = {pixels_option()},
                .kind = SamplerKind::set,
                .remark = "each dimension by itself; two together are as random",
                .max_samples = kMaxStrata};
    }

    LhsSampler(const SamplerOptions& options, const SamplingPlan& plan)
        : keys_(options, plan, 0x6c617468797065ull), count_(static_cast<std::uint32_t>(std::clamp<std::uint64_t>(plan.spp, 1, kMaxStrata))),
          scale_(0x1p24 / count_) {}

    /// An index of spp or above falls into the stratum of index mod spp, with a jitter of its own.
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {*this, keys_(pixel), index}; }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    std::uint32_t count_;
    double scale_;
};

}  // namespace koksma
