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

/// The high word of a product.
[[nodiscard]] constexpr std::uint32_t product_high(std::uint32_t a, std::uint32_t b) noexcept {
    return static_cast<std::uint32_t>((std::uint64_t{a} * b) >> 32);
}

/// The counter that gives a pixel the key of its digit permutations.
inline constexpr std::uint64_t kHaltonDigits = 0x68616c746f6eull;

/// Counters of the hashes whose digits, as binary fractions u in base b, are the images of zeros: digit p of u is the image of a zero
/// at place p, which is the high word of (u b^p modulo 1) b. So the images of all zeros behind an index cost one hash.
inline constexpr std::uint32_t kZeroImages = 0x80000000u;

/// The image of a digit under the permutation d -> a (1 / (d + c) - 1 / c) + zero (mod base), with 1/0 = 0.
/// The affine map around the inverse makes the images of one digit, and of any two, exactly as likely as under a uniformly random
/// permutation, and that is all that the variance of a scrambled estimate depends on; the inverse in between breaks the
/// arithmetic progressions that an affine map alone would leave in bases above the number of samples.
/// @param zero  the image of 0
/// @param hash  chooses a and c
/// Source: for the inverse, Eichenauer and Lehn 1986, "A non-linear congruential pseudo random number generator"
[[nodiscard]] inline std::uint32_t permuted_digit(const HaltonBase& b, std::uint32_t digit, std::uint32_t zero, std::uint32_t hash) noexcept {
    if (digit == 0) return zero;
    const std::uint32_t a = 1 + product_high(hash, b.base - 1), c = product_high(hash * (b.base - 1), b.base);
    const std::uint32_t x = digit + c;
    const std::uint32_t difference = b.inverse[x < b.base ? x : x - b.base] + b.base - b.inverse[c];
    const std::uint32_t y = a * (difference < b.base ? difference : difference - b.base) + zero;
    return y - b.quotient(y) * b.base;
}

class HaltonSampler {
public:
    enum class Randomize : std::uint8_t { none, shift, digits, owen };

    class Point {
    public:
        Point(const HaltonBase* bases, Key key, std::uint64_t index, Randomize randomize) noexcept
            : bases_(bases), index_(index), key_(key), digit_key_(join_key(derive_key(key, kHaltonDigits))), randomize_(randomize) {}

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
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    const HaltonBase* bases_;
    Randomize randomize_;
};

}  // namespace koksma
