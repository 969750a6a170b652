// Two and three numbers, and the little geometry that the hot path needs. `Real` is a float or a pack of lanes.
// GLM stays on the scene side and in the public API.

#include <koksma/simd/maths.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <concepts>
#include <type_traits>

#if defined(KOKSMA_MATH_VEC3_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_MATH_VEC3_H
#undef KOKSMA_MATH_VEC3_H
#else
#define KOKSMA_MATH_VEC3_H
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
struct Vec2 {
    Real x{}, y{};

    constexpr Vec2() = default;
    constexpr Vec2(Real x_, Real y_) : x(x_), y(y_) {}
    constexpr Vec2(const glm::vec2& v) requires std::same_as<Real, float> : x(v.x), y(v.y) {}
    constexpr operator glm::vec2() const requires std::same_as<Real, float> { return {x, y}; }
};

template <class Real>
struct Vec3 {
    Real x{}, y{}, z{};

    constexpr Vec3() = default;
    constexpr Vec3(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
    constexpr explicit Vec3(Real s) : x(s), y(s), z(s) {}
    /// The same vector in every lane. @param v  three floats
    template <class V>
    [[nodiscard]] static constexpr Vec3 splat(const V& v) {
        return {Real(v.x), Real(v.y), Real(v.z)};
    }
    constexpr Vec3(const glm::vec3& v) requires std::same_as<Real, float> : x(v.x), y(v.y), z(v.z) {}
    constexpr operator glm::vec3() const requires std::same_as<Real, float> { return {x, y, z}; }

};

// Free functions: GCC compiles friends that are defined in a class template without the instruction set.
template <class Real>
constexpr Vec3<Real> operator+(Vec3<Real> a, Vec3<Real> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
constexpr Vec3<Real> operator-(Vec3<Real> a, Vec3<Real> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
constexpr Vec3<Real> operator*(Vec3<Real> a, Vec3<Real> b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class Real>
constexpr Vec3<Real> operator*(Vec3<Real> a, std::type_identity_t<Real> s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class Real>
constexpr Vec3<Real> operator*(std::type_identity_t<Real> s, Vec3<Real> a) {
    return a * s;
}
template <class Real>
constexpr Vec3<Real> operator/(Vec3<Real> a, std::type_identity_t<Real> s) {
    return {a.x / s, a.y / s, a.z / s};
}
template <class Real>
constexpr Vec3<Real> operator-(Vec3<Real> a) {
    return {-a.x, -a.y, -a.z};
}
template <class Real>
constexpr Vec3<Real>& operator+=(Vec3<Real>& a, Vec3<Real> b) {
    return a = a + b;
}
template <class Real>
constexpr Vec3<Real>& operator*=(Vec3<Real>& a, Vec3<Real> b) {
    return a = a * b;
}
template <class Real>
constexpr Vec3<Real>& operator*=(Vec3<Real>& a, std::type_identity_t<Real> s) {
    return a = a * s;
}
template <class Real>
[[nodiscard]] constexpr MaskOf<Real> operator==(const Vec3<Real>& a, const Vec3<Real>& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
template <class Real>
[[nodiscard]] constexpr Real dot(Vec3<Real> a, Vec3<Real> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> cross(Vec3<Real> a, Vec3<Real> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
[[nodiscard]] Vec3<Real> abs(Vec3<Real> v) {
    return {abs(v.x), abs(v.y), abs(v.z)};
}
template <class Real>
[[nodiscard]] Real length(Vec3<Real> v) {
    return sqrt(dot(v, v));
}
/// @pre v is not zero and its squared length neither over- nor underflows
template <class Real>
[[nodiscard]] Vec3<Real> normalize(Vec3<Real> v) {
    return v * (Real(1) / length(v));
}
template <class Real>
[[nodiscard]] constexpr Real max_component(Vec3<Real> v) {
    const Real m = select(v.x > v.y, v.x, v.y);
    return select(m > v.z, m, v.z);
}
template <class Real>
[[nodiscard]] constexpr Real sum(Vec3<Real> v) {
    return v.x + v.y + v.z;
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> select(MaskOf<Real> m, const Vec3<Real>& yes, const Vec3<Real>& no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}
template <class Real>
constexpr void assign(MaskOf<Real> m, Vec3<Real>& dst, const Vec3<Real>& src) {
    dst = select<Real>(m, src, dst);
}

/// An orthonormal frame; `n` is its z axis.
template <class Real>
struct FrameOf {
    Vec3<Real> s, t, n;

    /// Continuous except at n.z = 0-; error below 1e-7 everywhere, also at n.z = -1.
    /// Source: Duff et al. 2017, "Building an orthonormal basis, revisited", JCGT 6(1)
    [[nodiscard]] static FrameOf from_normal(Vec3<Real> n) noexcept {
        const Real sign = copysign(Real(1), n.z);
        const Real a = Real(-1) / (sign + n.z);
        const Real b = n.x * n.y * a;
        return {{Real(1) + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
    }
    [[nodiscard]] Vec3<Real> to_local(Vec3<Real> v) const noexcept { return {dot(v, s), dot(v, t), dot(v, n)}; }
    [[nodiscard]] Vec3<Real> to_world(Vec3<Real> v) const noexcept { return s * v.x + t * v.y + n * v.z; }
};

#ifdef KOKSMA_ORDINARY
using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Frame = FrameOf<float>;

[[nodiscard]] constexpr Vec3d to_double(Vec3f v) { return {v.x, v.y, v.z}; }
[[nodiscard]] constexpr Vec3f to_float(Vec3d v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
[[nodiscard]] inline bool is_finite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
/// Luminance of linear sRGB (Rec. 709 weights).
[[nodiscard]] constexpr float luminance(Vec3f c) { return 0.212671f * c.x + 0.715160f * c.y + 0.072169f * c.z; }
#endif

KOKSMA_MATHS_END
#endif
