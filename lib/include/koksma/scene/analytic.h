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
    double t0 = c / q, t1 = q / a;
    if (q == 0.0) t0 = t1;
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
    const double t = dot(disk.center - to_double(ray.o), n) / dot(d, n);
    if (!(t > ray.t_near && t < ray.t_far)) return {};
    const Vec3d q = to_double(ray.o) + d * t - disk.center;
    const double nn = dot(n, n);
    const double x = dot(cross(q, disk.t), n) / nn, y = dot(cross(disk.s, q), n) / nn;
    if (!(x * x + y * y <= 1.0)) return {};
    return {t, x, y};
}

}  // namespace koksma
