#pragma once
// Elementary functions from + - * / sqrt and bit operations in fixed order: the same bits on every machine and for every
// vector width. No libm in the hot path (its results depend on the CPU that it finds).

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace koksma {

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;

struct SinCos {
    float sin, cos;
};

/// sin and cos of 2 pi u. @param u  any finite number; the argument is reduced exactly. Error below 1e-7.
/// Source: Taylor polynomials on an eighth of the circle, degree 9 and 8; the remainder is below half an ulp.
[[nodiscard]] inline SinCos sincos_turns(float u) noexcept {
    const float quarter = std::floor(4.0f * u + 0.5f);  // nearest multiple of a quarter turn
    const float x = (u - 0.25f * quarter) * (2.0f * kPi);  // in [-pi/4, pi/4]; the difference is exact
    const float x2 = x * x;
    const float s = x * (1.0f + x2 * (-1.6666667e-1f + x2 * (8.3333333e-3f + x2 * (-1.9841270e-4f + x2 * 2.7557319e-6f))));
    const float c = 1.0f + x2 * (-0.5f + x2 * (4.1666667e-2f + x2 * (-1.3888889e-3f + x2 * 2.4801587e-5f)));
    const auto q = static_cast<std::int32_t>(quarter - 4.0f * std::floor(0.25f * quarter));
    const float sin_q = (q & 1) != 0 ? c : s;
    const float cos_q = (q & 1) != 0 ? s : c;
    return {(q & 2) != 0 ? -sin_q : sin_q, ((q + 1) & 2) != 0 ? -cos_q : cos_q};
}

/// @param x  in [-87, 88]; relative error below 2e-7; smaller arguments give 0
/// Source: Cephes (Moshier 1989), expf: reduction by ln 2 in two parts and a minimax polynomial
[[nodiscard]] inline float exp_poly(float x) noexcept {
    if (!(x > -87.0f)) return 0.0f;
    const float n = std::floor(x * 1.44269504f + 0.5f);
    const float r = (x - n * 0.693359375f) - n * -2.12194440e-4f;
    const float r2 = r * r;
    const float p = ((((1.9875691500e-4f * r + 1.3981999507e-3f) * r + 8.3334519073e-3f) * r + 4.1665795894e-2f) * r + 1.6666665459e-1f) * r +
                    5.0000001201e-1f;
    const float y = p * r2 + r + 1.0f;
    return y * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

/// Natural logarithm. @param x  positive and normal; absolute error below 1e-7 near 1, relative 2e-7 elsewhere
/// Source: Cephes (Moshier 1989), logf
[[nodiscard]] inline float log_poly(float x) noexcept {
    auto bits = std::bit_cast<std::int32_t>(x);
    float e = static_cast<float>((bits >> 23) - 126);
    float m = std::bit_cast<float>((bits & 0x007fffff) | 0x3f000000);  // [0.5, 1)
    if (m < 0.707106781f) {
        e -= 1.0f;
        m = m + m - 1.0f;
    } else {
        m -= 1.0f;
    }
    const float z = m * m;
    float y = ((((((((7.0376836292e-2f * m - 1.1514610310e-1f) * m + 1.1676998740e-1f) * m - 1.2420140846e-1f) * m + 1.4249322787e-1f) * m -
                  1.6668057665e-1f) * m + 2.0000714765e-1f) * m - 2.4999993993e-1f) * m + 3.3333331174e-1f) * m * z;
    y += -2.12194440e-4f * e;
    y += -0.5f * z;
    return m + y + 0.693359375f * e;
}

/// Angle of (x, y) in [-pi, pi]; atan2(0, 0) = 0. Absolute error below 4e-7.
/// Source: Cephes (Moshier 1989), atanf, with the argument reduced to [0, tan(pi/8)]
[[nodiscard]] inline float atan2_poly(float y, float x) noexcept {
    const float ax = std::fabs(x), ay = std::fabs(y);
    const float hi = ax > ay ? ax : ay, lo = ax > ay ? ay : ax;
    if (hi == 0.0f) return 0.0f;
    float t = lo / hi, base = 0.0f;  // [0, 1]
    if (t > 0.4142135623f) {
        t = (t - 1.0f) / (t + 1.0f);
        base = 0.25f * kPi;
    }
    const float z = t * t;
    float a = base + ((((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z - 3.33329491539e-1f) * z * t + t);
    if (ay > ax) a = 0.5f * kPi - a;
    if (x < 0.0f) a = kPi - a;
    return y < 0.0f ? -a : a;
}

}  // namespace koksma
