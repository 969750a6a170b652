#pragma once
// The operations of shared maths on one number. A pack of lanes has the same ones by the same names (pack.h), so that a
// formula is written once, templated on `Real`: for a float a mask is a bool, and `select` is the conditional operator.

#include <bit>
#include <cmath>
#include <cstdint>

namespace koksma {

/// What goes with a Real: its comparisons' result, and 32-bit integers of as many lanes.
template <class Real>
struct Lanes;
template <>
struct Lanes<float> {
    using Mask = bool;
    using Int = std::int32_t;
    static constexpr int kCount = 1;
};

template <>
struct Lanes<double> {
    using Mask = bool;
    using Int = std::int64_t;
    static constexpr int kCount = 1;
};

template <class Real>
using MaskOf = typename Lanes<Real>::Mask;
template <class Real>
using IntOf = typename Lanes<Real>::Int;

[[nodiscard]] constexpr float select(bool m, float yes, float no) noexcept { return m ? yes : no; }
[[nodiscard]] constexpr double select(bool m, double yes, double no) noexcept { return m ? yes : no; }
[[nodiscard]] constexpr std::int32_t select(bool m, std::int32_t yes, std::int32_t no) noexcept { return m ? yes : no; }
/// dst = src in the lanes of the mask.
template <class T>
constexpr void assign(bool m, T& dst, const T& src) noexcept {
    if (m) dst = src;
}
[[nodiscard]] constexpr bool any(bool m) noexcept { return m; }
[[nodiscard]] constexpr bool all(bool m) noexcept { return m; }

[[nodiscard]] inline float abs(float x) noexcept { return std::fabs(x); }
[[nodiscard]] inline double abs(double x) noexcept { return std::fabs(x); }
[[nodiscard]] inline float sqrt(float x) noexcept { return std::sqrt(x); }
[[nodiscard]] inline double sqrt(double x) noexcept { return std::sqrt(x); }
[[nodiscard]] inline float floor(float x) noexcept { return std::floor(x); }
/// Magnitude of the first, sign of the second.
[[nodiscard]] inline float copysign(float magnitude, float sign) noexcept { return std::copysign(magnitude, sign); }
/// Conversion of a float that holds an integer of 32 bits (others: truncated; out of range: undefined).
[[nodiscard]] constexpr std::int32_t to_int(float x) noexcept { return static_cast<std::int32_t>(x); }
[[nodiscard]] constexpr float to_real(std::int32_t x) noexcept { return static_cast<float>(x); }
[[nodiscard]] constexpr std::int32_t bits_of(float x) noexcept { return std::bit_cast<std::int32_t>(x); }
[[nodiscard]] constexpr float real_of(std::int32_t bits) noexcept { return std::bit_cast<float>(bits); }
/// base[index]
[[nodiscard]] constexpr float gather(const float* base, std::int32_t index) noexcept { return base[index]; }
[[nodiscard]] constexpr std::int32_t gather(const std::int32_t* base, std::int32_t index) noexcept { return base[index]; }
/// out[w] = base[stride * index + w], w < words.
template <int words>
constexpr void load_rows(const float* base, std::int32_t stride, std::int32_t index, float (&out)[words]) noexcept {
    for (int w = 0; w < words; ++w) out[w] = base[static_cast<std::int64_t>(stride) * index + w];
}
/// x << n and arithmetic x >> n.
template <int n>
[[nodiscard]] constexpr std::int32_t shift_left(std::int32_t x) noexcept {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x) << n);
}
template <int n>
[[nodiscard]] constexpr std::int32_t shift_right(std::int32_t x) noexcept {
    return x >> n;
}

}  // namespace koksma
