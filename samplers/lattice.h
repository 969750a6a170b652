#pragma once
// lattice: an extensible rank-1 lattice sequence in base 2, point i = frac(phi(i) z) with phi the radical inverse.
// Source: Hickernell, Hong, L'Ecuyer and Lemieux 2000, "Extensible lattice sequences for quasi-Monte Carlo quadrature", SIAM
// J. Sci. Comput. 22(3); the generating vector z is data/lattice_cbc18.inc, made by tools/make_lattice.cpp after Cools, Kuo and
// Nuyens 2006; cp: Cranley and Patterson 1976; tent: Hickernell 2002, "Obtaining O(N^-2+eps) convergence for lattice
// quadrature rules".

#include "pixel_keys.h"

namespace koksma {

inline constexpr std::uint32_t kLatticeDimensions = 256;
inline constexpr std::uint64_t kLatticePoints = 1u << 18;

/// The generating vector, 256 odd numbers below 2^18.
[[nodiscard]] const std::uint32_t* lattice_vector() noexcept;

/// Coordinate of a point as a 32-bit binary fraction, exact for every index below 2^32.
[[nodiscard]] constexpr std::uint32_t lattice_bits(std::uint64_t index, std::uint32_t z) noexcept {
    return reverse_bits(static_cast<std::uint32_t>(index)) * z;
}

/// The tent 1 - |2x - 1| of a 32-bit binary fraction, rounded down, with tent(1/2) = 1 - 2^-32.
[[nodiscard]] constexpr std::uint32_t tent(std::uint32_t x) noexcept {
    if (x < 0x80000000u) return x << 1;
    return x == 0x80000000u ? 0xffffffffu : (0u - x) << 1;
}

class LatticeSampler {
public:
    class Point {
    public:
        Point(const LatticeSampler& sampler, Key key, std::uint64_t index) noexcept : sampler_(&sampler), key_(key), index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return value(slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept { return {value(slot.dimension), value(slot.dimension + 1)}; }

    private:
        [[nodiscard]] float value(std::uint32_t dimension) const noexcept {
            std::uint32_t x = lattice_bits(index_, sampler_->vector_[dimension]);
            if (sampler_->shift_) x += keyed_hash(key_, dimension);
            return unit_float(sampler_->tent_ ? tent(x) : x);
        }
        const LatticeSampler* sampler_;
        Key key_;
        std::uint64_t index_;
    };

    [[nodiscard]] static SamplerInfo info();
    LatticeSampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// @note  slots must end at or below dimension 256 (SampleSource draws the others from the tail)
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {*this, fixed_ ? Key{} : keys_(pixel), index}; }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    const std::uint32_t* vector_;
    bool tent_, fixed_;  ///< fixed: not randomised
    bool shift_;         ///< always with the tent: it would map x and 1 - x, both points of the lattice, to one
};

}  // namespace koksma
