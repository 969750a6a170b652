// Elementary functions from + - * / sqrt and bit operations in fixed order: the same bits on every machine and for every
// vector width. No libm in the hot path (its results depend on the CPU that it finds).

#include <koksma/simd/maths.h>

#include <cstdint>
#include <numbers>

#if defined(KOKSMA_SIMD_ELEMENTARY_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SIMD_ELEMENTARY_H
#undef KOKSMA_SIMD_ELEMENTARY_H
#else
#define KOKSMA_SIMD_ELEMENTARY_H
#endif

#ifdef KOKSMA_ORDINARY
namespace koksma {
inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
}  // namespace koksma
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
struct SinCosOf {
    Real sin, cos;
};

/// sin and cos of x in [-pi/4, pi/4]. Error below 1e-7.
/// Source: Taylor polynomials, degree 9 and 8; the remainder is below half an ulp.
template <class Real>
[[nodiscard]] SinCosOf<Real> sincos_eighth(Real x) noexcept {
    const Real x2 = x * x;
    return {x * (Real(1.0f) + x2 * (Real(-1.6666667e-1f) + x2 * (Real(8.3333333e-3f) + x2 * (Real(-1.9841270e-4f) + x2 * Real(2.7557319e-6f))))),
            Real(1.0f) + x2 * (Real(-0.5f) + x2 * (Real(4.1666667e-2f) + x2 * (Real(-1.3888889e-3f) + x2 * Real(2.4801587e-5f))))};
}

/// sin and cos of 2 pi u. @param u  any finite number; the argument is reduced exactly. Error below 1e-7.
template <class Real>
[[nodiscard]] SinCosOf<Real> sincos_turns(Real u) noexcept {
    using Int = IntOf<Real>;
    const Real quarter = floor(Real(4.0f) * u + Real(0.5f));            // nearest multiple of a quarter turn
    const Real x = (u - Real(0.25f) * quarter) * Real(2.0f * kPi);  // in [-pi/4, pi/4]; the difference is exact
    const auto [s, c] = sincos_eighth(x);
    const Int q = to_int(quarter - Real(4.0f) * floor(Real(0.25f) * quarter));
    const auto odd = (q & Int(1)) != Int(0);
    const Real sin_q = select(odd, c, s);
    const Real cos_q = select(odd, s, c);
    return {select((q & Int(2)) != Int(0), -sin_q, sin_q), select(((q + Int(1)) & Int(2)) != Int(0), -cos_q, cos_q)};
}

/// @param x  in [-87, 88]; relative error below 2e-7; smaller arguments give 0
/// Source: Cephes (Moshier 1989), expf: reduction by ln 2 in two parts and a minimax polynomial
template <class Real>
[[nodiscard]] Real exp_poly(Real x) noexcept {
    using Int = IntOf<Real>;
    const auto in_range = x > Real(-87.0f);
    x = select(in_range, x, Real(0.0f));
    const Real n = floor(x * Real(1.44269504f) + Real(0.5f));
    const Real r = (x - n * Real(0.693359375f)) - n * Real(-2.12194440e-4f);
    const Real r2 = r * r;
    const Real p = ((((Real(1.9875691500e-4f) * r + Real(1.3981999507e-3f)) * r + Real(8.3334519073e-3f)) * r + Real(4.1665795894e-2f)) * r +
                    Real(1.6666665459e-1f)) * r + Real(5.0000001201e-1f);
    const Real y = p * r2 + r + Real(1.0f);
    return select(in_range, y * real_of(shift_left<23>(to_int(n) + Int(127))), Real(0.0f));
}

/// Natural logarithm. @param x  positive and normal; absolute error below 1e-7 near 1, relative 2e-7 elsewhere
/// Source: Cephes (Moshier 1989), logf
template <class Real>
[[nodiscard]] Real log_poly(Real x) noexcept {
    using Int = IntOf<Real>;
    const Int bits = bits_of(x);
    Real e = to_real(shift_right<23>(bits) - Int(126));
    Real m = real_of((bits & Int(0x007fffff)) | Int(0x3f000000));  // [0.5, 1)
    const auto small = m < Real(0.707106781f);
    e = select(small, e - Real(1.0f), e);
    m = select(small, m + m - Real(1.0f), m - Real(1.0f));
    const Real z = m * m;
    Real y = ((((((((Real(7.0376836292e-2f) * m - Real(1.1514610310e-1f)) * m + Real(1.1676998740e-1f)) * m - Real(1.2420140846e-1f)) * m +
                   Real(1.4249322787e-1f)) * m - Real(1.6668057665e-1f)) * m + Real(2.0000714765e-1f)) * m - Real(2.4999993993e-1f)) * m +
              Real(3.3333331174e-1f)) * m * z;
    y += Real(-2.12194440e-4f) * e;
    y += Real(-0.5f) * z;
    return m + y + Real(0.693359375f) * e;
}

/// Angle of (x, y) in [-pi, pi]; atan2(0, 0) = 0. Absolute error below 4e-7.
/// Source: Cephes (Moshier 1989), atanf, with the argument reduced to [0, tan(pi/8)]
template <class Real>
[[nodiscard]] Real atan2_poly(Real y, Real x) noexcept {
    const Real ax = abs(x), ay = abs(y);
    const auto wide = ax > ay;
    const Real hi = select(wide, ax, ay), lo = select(wide, ay, ax);
    const auto zero = hi == Real(0.0f);
    const Real q = lo / select(zero, Real(1.0f), hi);  // [0, 1]
    const auto far = q > Real(0.4142135623f);
    const Real t = select(far, (q - Real(1.0f)) / (q + Real(1.0f)), q);
    const Real base = select(far, Real(0.25f * kPi), Real(0.0f));
    const Real z = t * t;
    Real a = base + ((((Real(8.05374449538e-2f) * z - Real(1.38776856032e-1f)) * z + Real(1.99777106478e-1f)) * z - Real(3.33329491539e-1f)) * z * t + t);
    a = select(ay > ax, Real(0.5f * kPi) - a, a);
    a = select(x < Real(0.0f), Real(kPi) - a, a);
    a = select(y < Real(0.0f), -a, a);
    return select(zero, Real(0.0f), a);
}

#ifdef KOKSMA_ORDINARY
using SinCos = SinCosOf<float>;
#endif

KOKSMA_MATHS_END
#endif
