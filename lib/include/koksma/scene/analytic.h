#pragma once
// Shapes that are not triangles. Intersected in double by one function each, for the BVH and for the hit point alike.

#include <koksma/math/vec3.h>
#include <koksma/scene/ray.h>

#include <cmath>
#include <utility>

namespace koksma {

struct AnalyticSphere {
    Vec3d center;
    double radius = 1.0;
};

/// Centre and the images of the unit x and y axes; normal along cross(s, t).
struct AnalyticDisk {
    Vec3d center, s, t;
};

/// A tube without caps from base to base + axis; s and t are unit, at right angles to the axis and to each other.
struct AnalyticCylinder {
    Vec3d base, axis, s, t;
    double radius = 1.0;
};

/// @return  the first t in (t_near, t_far) at which the ray meets the sphere, from outside or from inside; infinity if none
/// Source: the discriminant by projection, Haines et al. 2019, Ray Tracing Gems, chapter 7
[[nodiscard]] inline double intersect(const AnalyticSphere& sphere, const Ray& ray) noexcept {
    const Vec3d d = to_double(ray.d);
    const Vec3d f = to_double(ray.o) - sphere.center;
    const double a = dot(d, d);
    const double b = -dot(f, d);
    const Vec3d l = f + d * (b / a);
    const double discriminant = sphere.radius * sphere.radius - dot(l, l);
    if (!(discriminant >= 0.0)) return kInfinity;
    const double c = dot(f, f) - sphere.radius * sphere.radius;
    const double q = b + std::copysign(std::sqrt(a * discriminant), b);
    double t1 = q / a, t0 = q != 0.0 ? c / q : t1;
    if (t0 > t1) std::swap(t0, t1);
    if (t0 > ray.t_near && t0 < ray.t_far) return t0;
    if (t1 > ray.t_near && t1 < ray.t_far) return t1;
    return kInfinity;
}

/// A point of a disk's plane in the disk's own coordinates.
struct DiskHit {
    double t = kInfinity, x = 0.0, y = 0.0;
};

[[nodiscard]] inline DiskHit intersect(const AnalyticDisk& disk, const Ray& ray) noexcept {
    const Vec3d n = cross(disk.s, disk.t);
    const Vec3d d = to_double(ray.d);
    const double dn = dot(d, n);
    if (dn == 0.0) return {};  // along the plane
    const double t = dot(disk.center - to_double(ray.o), n) / dn;
    if (!(t > ray.t_near && t < ray.t_far)) return {};
    const Vec3d q = to_double(ray.o) + d * t - disk.center;
    const double nn = dot(n, n);
    const double x = dot(cross(q, disk.t), n) / nn, y = dot(cross(disk.s, q), n) / nn;
    if (!(x * x + y * y <= 1.0)) return {};
    return {t, x, y};
}

/// A point of a tube in its own coordinates: direction from the axis, and the way along it in [0, 1].
struct CylinderHit {
    double t = kInfinity, cosine = 1.0, sine = 0.0, along = 0.0;
};

/// As for the sphere, in the plane across the axis.
[[nodiscard]] inline CylinderHit intersect(const AnalyticCylinder& c, const Ray& ray) noexcept {
    const Vec3d d = to_double(ray.d), o = to_double(ray.o) - c.base;
    const double dx = dot(d, c.s), dy = dot(d, c.t), ox = dot(o, c.s), oy = dot(o, c.t);
    const double axis2 = dot(c.axis, c.axis), dz = dot(d, c.axis) / axis2, oz = dot(o, c.axis) / axis2;
    const double a = dx * dx + dy * dy, r2 = c.radius * c.radius;
    if (!(a > 0.0)) return {};  // along the axis
    const double b = -(dx * ox + dy * oy);
    const double lx = ox + dx * (b / a), ly = oy + dy * (b / a);
    const double discriminant = r2 - lx * lx - ly * ly;
    if (!(discriminant >= 0.0)) return {};
    const double q = b + std::copysign(std::sqrt(a * discriminant), b);
    double t1 = q / a, t0 = q != 0.0 ? (ox * ox + oy * oy - r2) / q : t1;
    if (t0 > t1) std::swap(t0, t1);
    for (const double t : {t0, t1}) {
        const double along = oz + dz * t;
        if (!(t > ray.t_near && t < ray.t_far && along >= 0.0 && along <= 1.0)) continue;
        const double x = ox + dx * t, y = oy + dy * t, inverse = 1.0 / std::sqrt(x * x + y * y);
        return {t, x * inverse, y * inverse, along};
    }
    return {};
}

// Where it is known that a ray meets a shape, but by other roundings than here: as above, and for a ray that narrowly misses, the point of
// the shape that it passes.

[[nodiscard]] inline double meet(const AnalyticSphere& sphere, const Ray& ray) noexcept {
    const double t = intersect(sphere, ray);
    if (t < kInfinity) return t;
    const Vec3d d = to_double(ray.d);
    return dot(sphere.center - to_double(ray.o), d) / dot(d, d);
}
[[nodiscard]] inline DiskHit meet(const AnalyticDisk& disk, const Ray& ray) noexcept {
    DiskHit hit = intersect(disk, Ray{ray.o, ray.d, -kInfinity, kInfinity});
    if (hit.t < kInfinity) return hit;
    const Vec3d n = cross(disk.s, disk.t), d = to_double(ray.d);
    const double dn = dot(d, n), nn = dot(n, n);
    if (dn == 0.0) return hit;
    hit.t = dot(disk.center - to_double(ray.o), n) / dn;
    const Vec3d q = to_double(ray.o) + d * hit.t - disk.center;
    const double x = dot(cross(q, disk.t), n) / nn, y = dot(cross(disk.s, q), n) / nn, r = std::sqrt(x * x + y * y);
    hit.x = r > 1.0 ? x / r : x;
    hit.y = r > 1.0 ? y / r : y;
    return hit;
}
[[nodiscard]] inline CylinderHit meet(const AnalyticCylinder& c, const Ray& ray) noexcept {
    CylinderHit hit = intersect(c, ray);
    if (hit.t < kInfinity) return hit;
    const Vec3d d = to_double(ray.d), o = to_double(ray.o) - c.base;
    const double dx = dot(d, c.s), dy = dot(d, c.t), ox = dot(o, c.s), oy = dot(o, c.t);
    const double axis2 = dot(c.axis, c.axis), dz = dot(d, c.axis) / axis2, oz = dot(o, c.axis) / axis2;
    const double a = dx * dx + dy * dy;
    hit.t = a > 0.0 ? -(dx * ox + dy * oy) / a : 0.0;
    const double x = ox + dx * hit.t, y = oy + dy * hit.t, r = std::sqrt(x * x + y * y);
    if (r > 0.0) hit.cosine = x / r, hit.sine = y / r;
    const double along = oz + dz * hit.t;
    hit.along = along > 0.0 ? (along < 1.0 ? along : 1.0) : 0.0;
    return hit;
}

/// Half extents of the box around a tube, about its middle.
[[nodiscard]] inline Vec3d reach(const AnalyticCylinder& c) noexcept {
    const auto one = [&](double s, double t, double a) { return c.radius * std::sqrt(s * s + t * t) + 0.5 * std::fabs(a); };
    return {one(c.s.x, c.t.x, c.axis.x), one(c.s.y, c.t.y, c.axis.y), one(c.s.z, c.t.z, c.axis.z)};
}

}  // namespace koksma
