#pragma once
// The film as seen by samplers that lay one sequence over the image.

#include <koksma/sampling/sampler.h>

#include <bit>

namespace koksma {

/// The longest side of a film that samplers of scope `image` take.
inline constexpr std::int32_t kMaxFilmSide = 1 << 16;

/// The plan itself. @throws Error when a side of its film is not in [1, 65536]
inline const SamplingPlan& with_film_checked(const SamplerOptions& options, const SamplingPlan& plan) {
    for (const std::int32_t side : {plan.film_width, plan.film_height})
        if (side < 1 || side > kMaxFilmSide)
            throw Error("sampler '" + options.canonical() + "' takes films of 1 to " + std::to_string(kMaxFilmSide) + " pixels a side; this one has " +
                        std::to_string(plan.film_width) + " x " + std::to_string(plan.film_height));
    return plan;
}

/// The least k with 2^k >= n. @param n  at least 1
[[nodiscard]] constexpr int ceil_log2(std::uint64_t n) noexcept { return static_cast<int>(std::bit_width(n - 1)); }

/// Where a layout's dimensions lie in a sequence whose first two dimensions are the position on the film: those of the film
/// slot are 0 and 1, all others follow in order from 2, wherever in the layout the film slot is. A layout without one (plain
/// integration) leaves 0 and 1 to the image.
class ImageDimensions {
public:
    explicit ImageDimensions(const DimensionLayout& layout) {
        for (const Slot& s : layout.slots())
            if (s.role == SlotRole::film) film_ = s.dimension;
    }
    [[nodiscard]] bool is_film(const Slot& slot) const noexcept { return slot.role == SlotRole::film; }
    /// @param slot  not of role film
    [[nodiscard]] std::uint32_t of(const Slot& slot) const noexcept { return slot.dimension > film_ ? slot.dimension : slot.dimension + 2; }

private:
    std::uint32_t film_ = ~std::uint32_t{0};
};

/// A point of a sequence over the image: the film slot is its position within the pixel, all others are those of the sequence.
/// @tparam Sampler   has film(pixel, index), the position, and dimensions()
/// @tparam Sequence  the point of the sequence's own sampler
template <class Sampler, class Sequence>
class ImagePoint {
public:
    ImagePoint(const Sampler& sampler, Pixel pixel, std::uint64_t index, const Sequence& rest) noexcept
        : sampler_(&sampler), pixel_(pixel), index_(index), rest_(rest) {}

    [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
        if (sampler_->dimensions().is_film(slot)) return sampler_->film(pixel_, index_).x;
        return rest_.get_1d({.dimension = sampler_->dimensions().of(slot)});
    }
    [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
        if (sampler_->dimensions().is_film(slot)) return sampler_->film(pixel_, index_);
        return rest_.get_2d({.dimension = sampler_->dimensions().of(slot), .arity = 2});
    }

private:
    const Sampler* sampler_;
    Pixel pixel_;
    std::uint64_t index_;
    Sequence rest_;
};

}  // namespace koksma
