#pragma once
// Affine maps in double: how a group's own space lies in the scene's.

#include <koksma/math/vec3.h>

#include <cmath>

namespace koksma {

/// p -> x p.x + y p.y + z p.z + t.
struct Placement {
    Vec3d x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0}, t{0.0, 0.0, 0.0};
};

[[nodiscard]] inline Vec3d vector_by(const Placement& m, Vec3d v) noexcept { return m.x * v.x + m.y * v.y + m.z * v.z; }
[[nodiscard]] inline Vec3d point_by(const Placement& m, Vec3d p) noexcept { return vector_by(m, p) + m.t; }
/// |m| |v|: what the map makes of a bound, coordinate by coordinate.
[[nodiscard]] inline Vec3d bound_by(const Placement& m, Vec3d v) noexcept { return abs(m.x) * v.x + abs(m.y) * v.y + abs(m.z) * v.z; }
/// A normal, by the inverse of the map: by the columns of its transpose. Not unit.
[[nodiscard]] inline Vec3d normal_by_inverse(const Placement& inverse, Vec3d n) noexcept {
    return {dot(inverse.x, n), dot(inverse.y, n), dot(inverse.z, n)};
}

/// a + (b - a) f as (1 - f) a + f b, which is Embree's.
[[nodiscard]] inline Placement between(const Placement& a, const Placement& b, double f) noexcept {
    const auto mix = [&](Vec3d u, Vec3d v) { return u * (1.0 - f) + v * f; };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), mix(a.t, b.t)};
}

[[nodiscard]] inline double determinant(const Placement& m) noexcept { return dot(m.x, cross(m.y, m.z)); }

/// @pre  the determinant is not zero
[[nodiscard]] inline Placement inverse(const Placement& m) noexcept {
    const double scale = 1.0 / determinant(m);
    const Vec3d r0 = cross(m.y, m.z) * scale, r1 = cross(m.z, m.x) * scale, r2 = cross(m.x, m.y) * scale;
    return {{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, -Vec3d{dot(r0, m.t), dot(r1, m.t), dot(r2, m.t)}};
}

/// How far from where it is Embree may take a ray's origin p to be, once it is brought into the group's space in float: measured in the
/// scene's space, coordinate by coordinate, at most matrix.{x, y, z} (|p| + matrix.t) + constant.
struct PlacementError {
    Placement matrix{{}, {}, {}, {}};  ///< no entry is negative
    Vec3d constant{};
    [[nodiscard]] Vec3d at(Vec3d p) const noexcept { return bound_by(matrix, abs(p) + matrix.t) + constant; }
};

/// Embree inverts the map by cofactors and multiplies, all in float. To first order each entry of the inverse is off by
/// (8 + 5 k) eps times the sum of the absolute products in its cofactor over |det|, where k is that of the determinant: the
/// absolute products over what they add up to. Multiplying and adding are 8 roundings more.
[[nodiscard]] inline PlacementError placement_error(const Placement& m) noexcept {
    const Vec3d ax = abs(m.x), ay = abs(m.y), az = abs(m.z);
    const auto products = [](Vec3d u, Vec3d v) { return Vec3d{u.y * v.z + u.z * v.y, u.z * v.x + u.x * v.z, u.x * v.y + u.y * v.x}; };
    const double det = std::fabs(determinant(m));
    const Vec3d r0 = products(ay, az), r1 = products(az, ax), r2 = products(ax, ay);
    const double scale = 0x1p-24 * (16.0 + 5.0 * dot(ax, r0) / det) / det;
    // |m| times those rows.
    const auto column = [&](double a, double b, double c) { return (ax * a + ay * b + az * c) * scale; };
    return {{column(r0.x, r1.x, r2.x), column(r0.y, r1.y, r2.y), column(r0.z, r1.z, r2.z), abs(m.t)}, {}};
}

}  // namespace koksma
