#pragma once
// The random numbers of a block of paths, fetched from the sampler by batch and read by role.

#include <koksma/integrators/thread_clock.h>
#include <koksma/math/vec3.h>
#include <koksma/plan/plan.h>
#include <koksma/sampling/sample_source.h>

#include <cstddef>
#include <span>
#include <vector>

namespace koksma {

/// Reads the slots of up to kCapacity paths. The camera's slots and those of the first bounces are filled for the whole
/// block at once, since nearly all paths need them; later bounces for one path at a time. One object per thread.
class Draws {
public:
    static constexpr std::size_t kCapacity = 64;
    static constexpr std::size_t kBlockBounces = 2;

    Draws(const RenderPlan& plan, const SampleSource& source)
        : plan_(plan), source_(source), camera_(dimension_count(plan.layout.camera()) * kCapacity) {
        std::uint32_t widest = 0;
        for (std::size_t b = 0; b < plan.layout.bounce_count(); ++b) {
            const std::uint32_t n = dimension_count(plan.layout.bounce(b));
            if (b < kBlockBounces) block_[b].resize(n * kCapacity);
            widest = n > widest ? n : widest;
        }
        single_.resize(widest);
    }

    /// Starts a block. `remember`: keep a list of its fills, for seconds_of_fills().
    void begin(std::span<const SampleId> samples, bool remember) {
        samples_ = samples;
        remember_ = remember;
        fills_.clear();
        for (bool& f : filled_) f = false;
        fill(samples_, plan_.layout.camera(), camera_.data(), kCapacity);
    }
    /// The path to read from now on.
    void select(std::size_t path) noexcept {
        path_ = path;
        single_bounce_ = kNoBounce;
    }
    [[nodiscard]] const SampleId& id() const noexcept { return samples_[path_]; }

    [[nodiscard]] Vec2f film() const noexcept { return {camera_[path_], camera_[kCapacity + path_]}; }
    [[nodiscard]] Vec2f lens() const noexcept {
        if (plan_.lens < 0) return {0.0f, 0.0f};  // a kernel with a lens, a scene without
        const float* row = &camera_[static_cast<std::size_t>(plan_.lens) * kCapacity + path_];
        return {row[0], row[kCapacity]};
    }
    [[nodiscard]] float time() const noexcept {
        return plan_.time < 0 ? 0.0f : camera_[static_cast<std::size_t>(plan_.time) * kCapacity + path_];
    }
    [[nodiscard]] float get_1d(std::size_t bounce, SlotRole role, std::int16_t BounceSlots::*member) noexcept {
        return bounce < plan_.bounces.size() ? value(bounce, plan_.bounces[bounce].*member, 0) : tail(bounce, role, 0);
    }
    [[nodiscard]] Vec2f get_2d(std::size_t bounce, SlotRole role, std::int16_t BounceSlots::*member) noexcept {
        if (bounce >= plan_.bounces.size()) return {tail(bounce, role, 0), tail(bounce, role, 1)};
        const std::int16_t offset = plan_.bounces[bounce].*member;
        return {value(bounce, offset, 0), value(bounce, offset, 1)};
    }
    [[nodiscard]] float light_choice(std::size_t b) noexcept { return get_1d(b, SlotRole::light_choice, &BounceSlots::light_choice); }
    [[nodiscard]] Vec2f light_position(std::size_t b) noexcept { return get_2d(b, SlotRole::light_position, &BounceSlots::light_position); }
    [[nodiscard]] float lobe(std::size_t b) noexcept { return get_1d(b, SlotRole::lobe, &BounceSlots::lobe); }
    [[nodiscard]] Vec2f direction(std::size_t b) noexcept { return get_2d(b, SlotRole::direction, &BounceSlots::direction); }
    [[nodiscard]] float distance(std::size_t b) noexcept { return get_1d(b, SlotRole::distance, &BounceSlots::distance); }
    [[nodiscard]] float collision(std::size_t b) noexcept { return get_1d(b, SlotRole::collision, &BounceSlots::collision); }
    [[nodiscard]] float passage(std::size_t b) noexcept { return get_1d(b, SlotRole::passage, &BounceSlots::passage); }
    [[nodiscard]] float roulette(std::size_t b) noexcept { return get_1d(b, SlotRole::roulette, &BounceSlots::roulette); }

    /// Does the remembered fills of the block again, in one go, and takes the time: a clock around each single fill would
    /// measure the clock.
    [[nodiscard]] double seconds_of_fills() {
        std::vector<float>& scratch = scratch_;
        scratch.resize(camera_.size() + block_[0].size() + block_[1].size() + single_.size());
        const double start = thread_seconds();
        for (const Fill& f : fills_) source_.fill(f.samples, f.run, scratch.data(), f.stride);
        return thread_seconds() - start;
    }

    /// Number k of a draw without a bound.
    [[nodiscard]] float tail(std::size_t bounce, SlotRole role, std::uint32_t k) noexcept {
        ++tail_numbers;
        return tail_sample(source_.seed(), id(), static_cast<std::uint32_t>(bounce), role, k);
    }

    std::uint64_t tail_numbers = 0;  ///< numbers drawn from the tail beyond the layout

private:
    static constexpr std::size_t kNoBounce = ~std::size_t{0};

    [[nodiscard]] float value(std::size_t bounce, std::int16_t offset, int k) noexcept {
        if (offset < 0) return 0.0f;  // the kernel has an effect that the scene lacks: it draws a number and does not use it
        const auto row = static_cast<std::size_t>(offset + k);
        if (bounce < kBlockBounces) {
            if (!filled_[bounce]) {
                fill(samples_, plan_.layout.bounce(bounce), block_[bounce].data(), kCapacity);
                filled_[bounce] = true;
            }
            return block_[bounce][row * kCapacity + path_];
        }
        if (single_bounce_ != bounce) {
            fill(samples_.subspan(path_, 1), plan_.layout.bounce(bounce), single_.data(), 1);
            single_bounce_ = bounce;
        }
        return single_[row];
    }
    void fill(std::span<const SampleId> ids, SlotRun run, float* out, std::size_t stride) noexcept {
        source_.fill(ids, run, out, stride);
        if (remember_) fills_.push_back({ids, run, stride});
    }

    struct Fill {
        std::span<const SampleId> samples;
        SlotRun run;
        std::size_t stride;
    };
    const RenderPlan& plan_;
    const SampleSource& source_;
    std::span<const SampleId> samples_;
    std::vector<float> camera_, block_[kBlockBounces], single_;
    bool filled_[kBlockBounces] = {};
    bool remember_ = false;
    std::vector<Fill> fills_;
    std::vector<float> scratch_;
    std::size_t path_ = 0, single_bounce_ = kNoBounce;
};

}  // namespace koksma
