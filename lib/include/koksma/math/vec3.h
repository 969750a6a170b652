#pragma once
// Three numbers, and the little geometry that the hot path needs. `Real` is float, or later a pack of lanes.
// GLM stays on the scene side and in the public API.

#include <glm/vec3.hpp>

#include <cmath>
#include <concepts>

namespace koksma {

template <class Real>
struct Vec3 {
    Real x{}, y{}, z{};

    constexpr Vec3() = default;
    constexpr Vec3(Real x_, Real y_, Real z_) : x(x_), y(y_), z(z_) {}
    constexpr explicit Vec3(Real s) : x(s), y(s), z(s) {}
    constexpr Vec3(const glm::vec3& v) requires std::same_as<Real, float> : x(v.x), y(v.y), z(v.z) {}
    constexpr operator glm::vec3() const requires std::same_as<Real, float> { return {x, y, z}; }

    friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend constexpr Vec3 operator*(Vec3 a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3 operator*(Real s, Vec3 a) { return a * s; }
    friend constexpr Vec3 operator/(Vec3 a, Real s) { return {a.x / s, a.y / s, a.z / s}; }
    friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
    constexpr Vec3& operator+=(Vec3 b) { return *this = *this + b; }
    constexpr Vec3& operator*=(Vec3 b) { return *this = *this * b; }
    constexpr Vec3& operator*=(Real s) { return *this = *this * s; }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class Real>
[[nodiscard]] constexpr Real dot(Vec3<Real> a, Vec3<Real> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
[[nodiscard]] constexpr Vec3<Real> cross(Vec3<Real> a, Vec3<Real> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline Vec3f abs(Vec3f v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
template <class Real>
[[nodiscard]] Real length(Vec3<Real> v) {
    return std::sqrt(dot(v, v));
}
/// @pre v is not zero and its squared length neither over- nor underflows
template <class Real>
[[nodiscard]] Vec3<Real> normalize(Vec3<Real> v) {
    return v * (Real(1) / length(v));
}
template <class Real>
[[nodiscard]] constexpr Real max_component(Vec3<Real> v) {
    const Real m = v.x > v.y ? v.x : v.y;
    return m > v.z ? m : v.z;
}
template <class Real>
[[nodiscard]] constexpr Real sum(Vec3<Real> v) {
    return v.x + v.y + v.z;
}
[[nodiscard]] constexpr Vec3d to_double(Vec3f v) { return {v.x, v.y, v.z}; }
[[nodiscard]] constexpr Vec3f to_float(Vec3d v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
[[nodiscard]] inline bool is_finite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
/// Luminance of linear sRGB (Rec. 709 weights).
[[nodiscard]] constexpr float luminance(Vec3f c) { return 0.212671f * c.x + 0.715160f * c.y + 0.072169f * c.z; }

/// An orthonormal frame; `n` is its z axis.
struct Frame {
    Vec3f s{1, 0, 0}, t{0, 1, 0}, n{0, 0, 1};

    /// Continuous except at n.z = 0-; error below 1e-7 everywhere, also at n.z = -1.
    /// Source: Duff et al. 2017, "Building an orthonormal basis, revisited", JCGT 6(1)
    [[nodiscard]] static Frame from_normal(Vec3f n) noexcept {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
    }
    [[nodiscard]] Vec3f to_local(Vec3f v) const noexcept { return {dot(v, s), dot(v, t), dot(v, n)}; }
    [[nodiscard]] Vec3f to_world(Vec3f v) const noexcept { return s * v.x + t * v.y + n * v.z; }
};

}  // namespace koksma
