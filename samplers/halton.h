#pragma once
// halton: radical inverses in the first 1024 primes, and their randomisations.
// Source: Halton 1964, "Algorithm 247: Radical-inverse quasi-random point sequence"; Cranley and Patterson 1976 (cp);
// Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences" (owen: nested permutations, here in prime bases).

#include "pixel_keys.h"
#include "primes.h"

#include <koksma/sampling/owen_hash.h>

namespace koksma {

/// What is needed of a base, computed once. All divisions by the base are products with `reciprocal`.
struct HaltonBase {
    std::uint32_t base = 2;
    std::uint32_t digits = 0;      ///< how many digits are permuted: the fewest with base^digits >= 2^24
    std::uint64_t reciprocal = 0;  ///< ceil(2^64 / base)
    std::uint64_t cells = 1;       ///< base^(digits - 1), below 2^24: the finest strata that all contain a float
    double scale = 0;              ///< 2^24 / cells
    double inverse_base = 0;       ///< 1 / base
    const std::uint16_t* inverse = nullptr;  ///< multiplicative inverses mod base, inverse[0] = 0

    /// n / base, exact.
    /// Source: Lemire, Kaser and Kurz 2019, "Faster remainder by direct computation", section 3
    [[nodiscard]] std::uint32_t quotient(std::uint32_t n) const noexcept {
        __extension__ typedef unsigned __int128 Wide;
        return static_cast<std::uint32_t>((static_cast<Wide>(reciprocal) * n) >> 64);
    }
    [[nodiscard]] std::uint64_t quotient(std::uint64_t n) const noexcept {
        return n >> 32 ? n / base : quotient(static_cast<std::uint32_t>(n));
    }
};

/// The bases of all dimensions. Built at the first call (about 7 MiB of inverses); thread-safe.
[[nodiscard]] const HaltonBase* halton_bases();

/// Radical inverse of any 64-bit index as a float: base 2 truncated to 24 bits, other bases the smallest multiple of 2^-24
/// that is not below the exact value, capped at 1 - 2^-24.
[[nodiscard]] float radical_inverse(const HaltonBase& base, std::uint64_t index) noexcept;

/// Radical inverse as a 32-bit binary fraction, truncated.
[[nodiscard]] std::uint32_t radical_inverse_bits(const HaltonBase& base, std::uint64_t index) noexcept;

class HaltonSampler {
public:
    enum class Randomize : std::uint8_t { none, shift, digits, owen };

    class Point {
    public:
        Point(const HaltonBase* bases, Key key, std::uint64_t index, Randomize randomize) noexcept
            : bases_(bases), index_(index), key_(key), digit_key_(join_key(derive_key(key, 0x68616c746f6eull))), randomize_(randomize) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return value(slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept { return {value(slot.dimension), value(slot.dimension + 1)}; }

    private:
        [[nodiscard]] float value(std::uint32_t dimension) const noexcept;

        const HaltonBase* bases_;
        std::uint64_t index_;
        Key key_;
        std::uint64_t digit_key_;
        Randomize randomize_;
    };

    [[nodiscard]] static SamplerInfo info();
    HaltonSampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// @note  slots must end at or below dimension 1024 (SampleSource draws the others from the tail)
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {bases_, keys_(pixel), index, randomize_}; }

private:
    PixelKeys keys_;
    const HaltonBase* bases_;
    Randomize randomize_;
};

}  // namespace koksma
