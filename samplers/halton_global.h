#pragma once
// halton-global: one Halton sequence over the whole image. Bases 2 and 3 are the position on the film; a pixel takes the
// points that fall into it, found by inverting their leading digits.
// Source: Gruenschloss, Raab and Keller 2012, "Enumerating quasi-Monte Carlo point sequences in elementary intervals" (Monte
// Carlo and Quasi-Monte Carlo Methods 2010), section 2: the Halton sequence and the Chinese remainder theorem.

#include "film_bits.h"
#include "halton.h"

namespace koksma {

/// Which points of the sequence lie in which pixel of a grid of 2^j x 3^k.
class HaltonEnumeration {
public:
    /// The smallest grid that holds a film. @param width, height  in [1, 65536]
    HaltonEnumeration(std::uint64_t width, std::uint64_t height) noexcept;

    /// The index of the n-th point of a pixel. A bijection between (pixel of the grid, n) and the indices.
    /// @param pixel  inside the grid
    /// @param n      below 2^64 / stride()
    [[nodiscard]] std::uint64_t index(Pixel pixel, std::uint64_t n) const noexcept;
    /// 2^j 3^k: from one point of a pixel to the next.
    [[nodiscard]] std::uint64_t stride() const noexcept { return columns_ * rows_; }
    /// The indices whose radical inverses are the position within the pixel.
    [[nodiscard]] std::uint64_t column_index(std::uint64_t index) const noexcept { return index >> column_bits_; }
    [[nodiscard]] std::uint64_t row_index(std::uint64_t index) const noexcept { return index / rows_; }

private:
    int column_bits_;
    std::uint64_t columns_, rows_ = 1;
    int row_digits_ = 0;
    std::uint64_t inverse_ = 0;  ///< of columns_ modulo rows_
};

class HaltonGlobalSampler {
public:
    using Point = ImagePoint<HaltonGlobalSampler, HaltonSampler::Point>;

    [[nodiscard]] static SamplerInfo info();
    HaltonGlobalSampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// @note  slots must end at or below dimension 1022 (SampleSource draws the others from the tail)
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        const std::uint64_t i = enumeration_.index(pixel, index);
        return {*this, pixel, i, HaltonSampler::Point(bases_, key_, i, randomize_)};
    }
    /// Where a point of the sequence lies within its pixel. @param index  of the sequence
    [[nodiscard]] glm::vec2 film(Pixel pixel, std::uint64_t index) const noexcept;
    [[nodiscard]] const ImageDimensions& dimensions() const noexcept { return dimensions_; }

private:
    const HaltonBase* bases_;
    HaltonEnumeration enumeration_;
    ImageDimensions dimensions_;
    Key key_;
    HaltonSampler::Randomize randomize_;
};

}  // namespace koksma
