// Points of triangles, recomputed from their vertices.

#include <koksma/math/vec3.h>
#include <koksma/scene/ray_offset.h>

#if defined(KOKSMA_SCENE_TRIANGLE_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_TRIANGLE_H
#undef KOKSMA_SCENE_TRIANGLE_H
#else
#define KOKSMA_SCENE_TRIANGLE_H
#endif

KOKSMA_MATHS_BEGIN

/// Barycentrics of the second and third vertex at a hit, clamped into the triangle (Embree has said that the ray hits it).
/// Source: signed volumes relative to the ray's origin, as in Woop et al. 2013, JCGT 2(1)
template <class Real>
[[nodiscard]] Vec2<Real> barycentrics(Vec3<Real> v0, Vec3<Real> v1, Vec3<Real> v2, Vec3<Real> o, Vec3<Real> d) noexcept {
    const Vec3<Real> a = v0 - o, b = v1 - o, c = v2 - o;
    const Real s0 = dot(d, cross(c, b)), s1 = dot(d, cross(a, c)), s2 = dot(d, cross(b, a));
    const auto turned = s0 + s1 + s2 < Real(0.0f);
    const auto volume = [&](Real s) {
        const Real w = select(turned, -s, s);
        return select(w > Real(0.0f), w, Real(0.0f));
    };
    const Real w0 = volume(s0), w1 = volume(s1), w2 = volume(s2);
    const Real sum = w0 + w1 + w2;
    const auto regular = sum > Real(0.0f);  // else the ray lies in the plane; any point of the triangle will do
    const Real divisor = select(regular, sum, Real(1.0f));
    return {select(regular, w1 / divisor, Real(1.0f / 3.0f)), select(regular, w2 / divisor, Real(1.0f / 3.0f))};
}

/// A point in the plane of a triangle, with what rounding may have done to it.
template <class Real>
struct TrianglePointOf {
    Vec3<Real> p, p_error;  ///< a convex combination of the vertices; bound of the absolute error of each coordinate
    Real b0;                ///< barycentric of the first vertex
};

/// @param b  barycentrics of the second and third vertex
template <class Real>
[[nodiscard]] TrianglePointOf<Real> triangle_point(Vec3<Real> v0, Vec3<Real> v1, Vec3<Real> v2, Vec2<Real> b) noexcept {
    const Real rest = Real(1.0f) - b.x - b.y;
    const Real b0 = select(rest > Real(0.0f), rest, Real(0.0f));
    const Vec3<Real> t0 = v0 * b0, t1 = v1 * b.x, t2 = v2 * b.y;
    return {t0 + t1 + t2, (abs(t0) + abs(t1) + abs(t2)) * Real(error_gamma(7)), b0};
}

/// @return  unit, to the side from which the vertices turn counter-clockwise; +z where they are in line
template <class Real>
[[nodiscard]] Vec3<Real> triangle_normal(Vec3<Real> v0, Vec3<Real> v1, Vec3<Real> v2) noexcept {
    const Vec3<Real> e1 = v1 - v0, e2 = v2 - v0;
    // Scaled before squaring: the product of two tiny edges would underflow.
    const Real scale = Real(1.0f) / max_component(Vec3<Real>{max_component(abs(e1)), max_component(abs(e2)), Real(1e-30f)});
    const Vec3<Real> n = cross(e1 * scale, e2 * scale);
    const Real len2 = dot(n, n);
    const auto regular = len2 > Real(0.0f);
    const Vec3<Real> unit = n * (Real(1.0f) / sqrt(select(regular, len2, Real(1.0f))));
    return select<Real>(regular, unit, Vec3<Real>{Real(0.0f), Real(0.0f), Real(1.0f)});
}

/// True where the sine of the angle at the first vertex is below 1/16: edges nearly cancel in the normal, and volumes in the barycentrics,
/// which slide the point along the needle. Double is needed for both.
template <class Real>
[[nodiscard]] MaskOf<Real> is_needle(Vec3<Real> v0, Vec3<Real> v1, Vec3<Real> v2) noexcept {
    const Vec3<Real> e1 = v1 - v0, e2 = v2 - v0;
    const Real scale = Real(1.0f) / max_component(Vec3<Real>{max_component(abs(e1)), max_component(abs(e2)), Real(1e-30f)});
    const Vec3<Real> s1 = e1 * scale, s2 = e2 * scale, n = cross(s1, s2);
    return dot(n, n) < dot(s1, s1) * dot(s2, s2) * Real(0x1p-8f);
}

/// True where a point between vertices is too coarse for the ray that found it: its error exceeds 2^-12 of the way. So it is
/// on a triangle thousands of times as large as the way, where also Embree's choice between two neighbours is that coarse.
template <class Real>
[[nodiscard]] MaskOf<Real> is_coarse(Vec3<Real> p, Vec3<Real> p_error, Vec3<Real> o) noexcept {
    return max_component(p_error) > max_component(abs(p - o)) * Real(0x1p-12f);
}

/// A normal interpolated between the vertices', unit; `otherwise` where they cancel out.
template <class Real>
[[nodiscard]] Vec3<Real> interpolated_normal(Vec3<Real> n0, Vec3<Real> n1, Vec3<Real> n2, Real b0, Vec2<Real> b, Vec3<Real> otherwise) noexcept {
    const Vec3<Real> m = n0 * b0 + n1 * b.x + n2 * b.y;
    const Real m2 = dot(m, m);
    const auto regular = m2 > Real(0.0f);
    return select<Real>(regular, m * (Real(1.0f) / sqrt(select(regular, m2, Real(1.0f)))), otherwise);
}

/// Frame around n with s along dpdu as far as possible.
template <class Real>
[[nodiscard]] FrameOf<Real> frame_along(Vec3<Real> n, Vec3<Real> dpdu) noexcept {
    const Vec3<Real> s = dpdu - n * dot(n, dpdu);
    const Real len2 = dot(s, s);
    const auto regular = len2 > Real(0.0f);
    const FrameOf<Real> any_frame = FrameOf<Real>::from_normal(n);
    const Vec3<Real> unit = s * (Real(1.0f) / sqrt(select(regular, len2, Real(1.0f))));
    return {select<Real>(regular, unit, any_frame.s), select<Real>(regular, cross(n, unit), any_frame.t), n};
}

/// Direction in which u grows, up to its length. @param uv0, uv1, uv2  zero determinant: a zero vector
template <class Real>
[[nodiscard]] Vec3<Real> direction_of_u(Vec3<Real> v0, Vec3<Real> v1, Vec3<Real> v2, Vec2<Real> uv0, Vec2<Real> uv1, Vec2<Real> uv2) noexcept {
    const Vec3<Real> e1 = v1 - v0, e2 = v2 - v0;
    const Real du1 = uv1.x - uv0.x, dv1 = uv1.y - uv0.y, du2 = uv2.x - uv0.x, dv2 = uv2.y - uv0.y;
    const Real det = du1 * dv2 - dv1 * du2;
    const Real sign = select(det > Real(0.0f), Real(1.0f), select(det < Real(0.0f), Real(-1.0f), Real(0.0f)));
    return (e1 * dv2 - e2 * dv1) * sign;
}

KOKSMA_MATHS_END
#endif
