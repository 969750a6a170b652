#pragma once
// The table of all slots of a path, computed from the effects of a scene before the first ray.

#include <koksma/sampling/slot.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace koksma {

/// All slots of a path in order: those of the camera, then those of each bounce. Plain data; made by `make_layout`
/// (koksma/plan) or by hand (`plain_layout`, tests). Bounces beyond `bounce_count()` have no slots: they draw from the tail.
class DimensionLayout {
public:
    /// Appends a slot at the next free dimension. Slots are added in order of bounce; camera slots come first.
    void add_camera(SlotRole role, std::uint8_t arity) {
        add({next_, 0, role, arity, 0});
        camera_end_ = slots_.size();
    }
    void begin_bounce() { bounce_begin_.push_back(slots_.size()); }
    void add_bounce(SlotRole role, std::uint8_t arity) {
        const auto bounce = static_cast<std::uint16_t>(bounce_begin_.size() - 1);
        add({next_, bounce, role, arity, static_cast<std::uint16_t>(bounce + 1)});
    }

    [[nodiscard]] SlotRun slots() const noexcept { return slots_; }
    [[nodiscard]] SlotRun camera() const noexcept { return SlotRun(slots_).first(camera_end_); }
    [[nodiscard]] std::size_t bounce_count() const noexcept { return bounce_begin_.size(); }
    /// The slots of one bounce; empty beyond the last.
    [[nodiscard]] SlotRun bounce(std::size_t b) const noexcept {
        if (b >= bounce_begin_.size()) return {};
        const std::size_t end = b + 1 < bounce_begin_.size() ? bounce_begin_[b + 1] : slots_.size();
        return SlotRun(slots_).subspan(bounce_begin_[b], end - bounce_begin_[b]);
    }
    /// The slot of a role within a run, or nullptr.
    [[nodiscard]] static const Slot* find(SlotRun run, SlotRole role) noexcept {
        for (const Slot& s : run)
            if (s.role == role) return &s;
        return nullptr;
    }
    /// Total number of dimensions.
    [[nodiscard]] std::uint32_t dimensions() const noexcept { return next_; }

private:
    void add(Slot s) {
        slots_.push_back(s);
        next_ += s.arity;
    }
    std::vector<Slot> slots_;
    std::vector<std::size_t> bounce_begin_;
    std::size_t camera_end_ = 0;
    std::uint32_t next_ = 0;
};

/// A layout for plain integration: `arities[i]` numbers drawn jointly in slot i (tests, integrands, point plots).
[[nodiscard]] inline DimensionLayout plain_layout(std::span<const std::uint8_t> arities) {
    DimensionLayout layout;
    for (const std::uint8_t a : arities) {
        layout.begin_bounce();  // a bounce each: slots that come from the tail are told apart by role and bounce
        layout.add_bounce(SlotRole::direction, a);
    }
    return layout;
}

}  // namespace koksma
