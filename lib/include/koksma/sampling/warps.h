// Maps from the unit square to the domains that a path tracer samples. Continuous, so neighbouring strata stay neighbours.

#include <koksma/math/vec3.h>
#include <koksma/simd/elementary.h>

#if defined(KOKSMA_SAMPLING_WARPS_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SAMPLING_WARPS_H
#undef KOKSMA_SAMPLING_WARPS_H
#else
#define KOKSMA_SAMPLING_WARPS_H
#endif

KOKSMA_MATHS_BEGIN

/// Uniform on the unit disk.
/// @param u  [0, 1)^2
/// Source: Shirley and Chiu 1997, "A low distortion map between disk and square", JGT 2(3)
template <class Real>
[[nodiscard]] Vec2<Real> square_to_disk(Vec2<Real> u) noexcept {
    const Real a = Real(2.0f) * u.x - Real(1.0f), b = Real(2.0f) * u.y - Real(1.0f);
    const auto wide = abs(a) > abs(b);
    const Real r = select(wide, a, b);
    const Real quotient = select(wide, b, a) / select(r == Real(0.0f), Real(1.0f), r);  // at the centre any angle will do
    const SinCosOf<Real> sc = sincos_eighth(Real(0.25f * kPi) * quotient);  // of the angle from the nearer axis
    return {r * select(wide, sc.cos, sc.sin), r * select(wide, sc.sin, sc.cos)};
}

/// Cosine-weighted on the hemisphere around +z.
/// @return  unit vector, z >= 0; density z / pi per steradian; z is 0 for no u in [0, 1)^2 beyond rounding
template <class Real>
[[nodiscard]] Vec3<Real> square_to_cosine_hemisphere(Vec2<Real> u) noexcept {
    const Vec2<Real> d = square_to_disk(u);
    const Real z2 = Real(1.0f) - d.x * d.x - d.y * d.y;
    return {d.x, d.y, sqrt(select(z2 > Real(0.0f), z2, Real(0.0f)))};
}

/// Uniform on the sphere; density 1 / (4 pi).
template <class Real>
[[nodiscard]] Vec3<Real> square_to_sphere(Vec2<Real> u) noexcept {
    const Real z = Real(1.0f) - Real(2.0f) * u.y;
    const Real r = Real(2.0f) * sqrt(u.y * (Real(1.0f) - u.y));  // sqrt(1 - z^2) without its cancellation
    const SinCosOf<Real> sc = sincos_turns(u.x);
    return {r * sc.cos, r * sc.sin, z};
}

/// Uniform on a triangle. @return  barycentrics of the second and third vertex
/// Source: Heitz 2019, "A low-distortion map between triangle and square"
template <class Real>
[[nodiscard]] Vec2<Real> square_to_triangle(Vec2<Real> u) noexcept {
    const auto upper = u.y > u.x;
    const Real x = Real(0.5f) * u.x, y = Real(0.5f) * u.y;
    return {select(upper, x, u.x - y), select(upper, u.y - x, y)};
}

/// 1 - cos(theta) from sin^2(theta), for theta in [0, pi/2], without cancellation.
template <class Real>
[[nodiscard]] Real one_minus_cos(Real sin2) noexcept {
    const Real cos2 = Real(1.0f) - sin2;
    return sin2 / (Real(1.0f) + sqrt(select(cos2 > Real(0.0f), cos2, Real(0.0f))));
}

/// Uniform in a cone around +z. @param one_minus_cos_max  1 - cos of the half angle, > 0
/// @return  unit vector; density 1 / (2 pi one_minus_cos_max)
template <class Real>
[[nodiscard]] Vec3<Real> square_to_cone(Vec2<Real> u, Real one_minus_cos_max) noexcept {
    const Real h = u.y * one_minus_cos_max;          // 1 - cos(theta)
    const Real r = sqrt(h * (Real(2.0f) - h));       // sin(theta), no cancellation for small cones
    const SinCosOf<Real> sc = sincos_turns(u.x);
    return {r * sc.cos, r * sc.sin, Real(1.0f) - h};
}

KOKSMA_MATHS_END
#endif
