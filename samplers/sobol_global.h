#pragma once
// sobol-global: one Sobol' sequence over the whole image. Its first two dimensions are the position on the film; a pixel
// takes the points that fall into it, found by inverting their leading digits.
// Source: Gruenschloss, Raab and Keller 2012, "Enumerating quasi-Monte Carlo point sequences in elementary intervals" (Monte
// Carlo and Quasi-Monte Carlo Methods 2010). That the film's sides may be different powers of two follows from dimensions 0
// and 1 being a (0, 2)-sequence; the closed forms (sobol_pair.h) and the scrambling below the pixel are ours.

#include "film_bits.h"
#include "sobol.h"
#include "sobol_pair.h"

#include <array>

namespace koksma {

/// Which points of the sequence lie in which pixel of a grid of 2^width_bits x 2^height_bits.
class SobolEnumeration {
public:
    /// @param width_bits, height_bits  in [0, 16]
    SobolEnumeration(int width_bits, int height_bits) noexcept;

    /// The index of the n-th point of a pixel: bits from width_bits + height_bits on are n; those below are solved for.
    /// A bijection between (pixel, n) and the 64-bit indices.
    /// @param pixel  inside the grid (other bits are dropped)
    /// @param n      below 2^(64 - width_bits - height_bits)
    [[nodiscard]] std::uint64_t index(Pixel pixel, std::uint64_t n) const noexcept;

    /// Position within the pixel, bit-reversed: the 32 digits that follow those of the pixel.
    struct Position {
        std::uint32_t x_rev, y_rev;
    };
    [[nodiscard]] Position within_pixel(std::uint64_t index) const noexcept {
        return {static_cast<std::uint32_t>(index >> width_bits_), static_cast<std::uint32_t>(pascal_rev(index) >> height_bits_)};
    }

private:
    int width_bits_, height_bits_;
    std::array<std::uint64_t, 16> solution_{};  ///< what to add to the index for each digit of y that is to be flipped
};

class SobolGlobalSampler {
public:
    using Point = ImagePoint<SobolGlobalSampler, SobolSampler::Point>;

    [[nodiscard]] static SamplerInfo info();
    SobolGlobalSampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// @note  slots must end at or below dimension 4094 (SampleSource draws the others from the tail)
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        const std::uint64_t i = enumeration_.index(pixel, index);
        return {*this, pixel, i, SobolSampler::Point(matrices_, key_, i, randomize_)};
    }
    /// Where a point of the sequence lies within its pixel. @param index  of the sequence
    [[nodiscard]] glm::vec2 film(Pixel pixel, std::uint64_t index) const noexcept;
    [[nodiscard]] const ImageDimensions& dimensions() const noexcept { return dimensions_; }

private:
    const SobolNibble* matrices_;
    SobolEnumeration enumeration_;
    ImageDimensions dimensions_;
    Key key_;
    SobolSampler::Randomize randomize_;
};

}  // namespace koksma
