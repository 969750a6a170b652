// The arithmetic of light sampling that both kernels share.

#include <koksma/math/vec3.h>
#include <koksma/scene/ray_offset.h>

#if defined(KOKSMA_SCENE_LIGHT_MATHS_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_LIGHT_MATHS_H
#undef KOKSMA_SCENE_LIGHT_MATHS_H
#else
#define KOKSMA_SCENE_LIGHT_MATHS_H
#endif

KOKSMA_MATHS_BEGIN

/// Multiple importance sampling weight of a technique with density a against one with density b.
/// The ratio form neither overflows nor gives 0/0 for densities beyond the square root of float's range.
/// Source: Veach 1997, section 9.2.4 (power heuristic, exponent 2)
template <class Real>
[[nodiscard]] constexpr Real power_heuristic(Real a, Real b) noexcept {
    const auto possible = a > Real(0.0f);
    const Real r = b / select(possible, a, Real(1.0f));
    return select(possible, Real(1.0f) / (Real(1.0f) + r * r), Real(0.0f));
}

/// Density per steradian of a point at distance^2 whose normal makes |cos| with the direction; 0 where no float holds the area seen.
template <class Real>
[[nodiscard]] constexpr Real area_to_solid_angle(Real distance2, Real abs_cos, Real area) noexcept {
    const Real seen = abs_cos * area;
    const auto visible = seen > Real(0.0f);
    return select(visible, distance2 / select(visible, seen, Real(1.0f)), Real(0.0f));
}

/// The end of a shadow ray on a light's surface, moved off it to the side of `side`. Beyond the error of the point itself, Embree
/// rounds differences between the ray's origin and the light's vertices, so its error at the light grows with the distance:
/// 8 roundings of it (2 in the direction, 6 in the plane's dot product and quotient). Without this, 0.16 % of the shadow
/// rays to a rectangle 4 m away met the rectangle.
template <class Real>
[[nodiscard]] Vec3<Real> shadow_target(Vec3<Real> p, Vec3<Real> p_error, Vec3<Real> ng, Real distance, Vec3<Real> side) noexcept {
    return offset_origin(p, p_error + Vec3<Real>(distance * Real(error_gamma(8))), ng, side);
}

/// True if Embree may see the ray: finite, with a direction, and within the 1.844e18 beyond which it asserts.
template <class Real>
[[nodiscard]] MaskOf<Real> is_traceable(Vec3<Real> o, Vec3<Real> d) noexcept {
    const Real limit2{3.4e36f};  // the square of 1.844e18; a NaN fails every comparison
    const Real o2 = dot(o, o), d2 = dot(d, d);
    return o2 < limit2 && d2 < limit2 && d2 > Real(0.0f);
}

KOKSMA_MATHS_END
#endif
