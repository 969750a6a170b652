// Where rays may start without hitting the surface that they leave.

#include <koksma/math/vec3.h>

#if defined(KOKSMA_SCENE_RAY_OFFSET_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_RAY_OFFSET_H
#undef KOKSMA_SCENE_RAY_OFFSET_H
#else
#define KOKSMA_SCENE_RAY_OFFSET_H
#endif

#ifdef KOKSMA_ORDINARY
namespace koksma {

/// gamma_n = n eps / (1 - n eps): bounds the relative error of n roundings.
/// Source: Higham 2002, Accuracy and Stability of Numerical Algorithms, lemma 3.1
[[nodiscard]] constexpr float error_gamma(int n) noexcept {
    constexpr float kEps = 0x1p-24f;
    return static_cast<float>(n) * kEps / (1.0f - static_cast<float>(n) * kEps);
}

}  // namespace koksma
#endif

KOKSMA_MATHS_BEGIN

/// The next float above x where `up`, else the next below. @param x  finite
template <class Real>
[[nodiscard]] Real next_float(Real x, MaskOf<Real> up) noexcept {
    using Int = IntOf<Real>;
    const Int bits = bits_of(x);
    const auto away = (x > Real(0.0f)) == up;  // from zero
    const Int next = bits + select(away, Int(1), Int(-1));
    const Int least = select(up, Int(1), Int(static_cast<std::int32_t>(0x80000001u)));  // the smallest denormal
    return real_of(select(x == Real(0.0f), least, next));
}

/// Moves a point off its surface, to the side of w, just beyond the box that is known to hold the true point.
/// @param p_error  bound of the absolute error of each coordinate of p
/// @param ng       geometric normal, unit, either side
/// Source: Pharr, Jakob and Humphreys 2023, Physically Based Rendering, 4th ed., section 6.8.6
template <class Real>
[[nodiscard]] Vec3<Real> offset_origin(Vec3<Real> p, Vec3<Real> p_error, Vec3<Real> ng, Vec3<Real> w) noexcept {
    // A plane through the camera, at coordinate 0, has no error at all, but a ray that starts in it would meet it again at distance 0.
    const Real d = dot(abs(ng), p_error) + Real(1e-20f);
    const Vec3<Real> offset = ng * select(dot(w, ng) < Real(0.0f), -d, d);
    Vec3<Real> q = p + offset;
    // The addition rounds: step one float further out wherever there is an offset.
    q.x = select(offset.x != Real(0.0f), next_float<Real>(q.x, offset.x > Real(0.0f)), q.x);
    q.y = select(offset.y != Real(0.0f), next_float<Real>(q.y, offset.y > Real(0.0f)), q.y);
    q.z = select(offset.z != Real(0.0f), next_float<Real>(q.z, offset.z > Real(0.0f)), q.z);
    return q;
}

KOKSMA_MATHS_END
#endif
