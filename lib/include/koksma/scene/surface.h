#pragma once
// The point that a ray met, recomputed from the scene's own data.

#include <koksma/scene/scene.h>

namespace koksma {

struct Surface {
    Vec3f p;             ///< in the plane of the triangle (a convex combination of its vertices) or on the shape
    Vec3f p_error;       ///< bound of the absolute error of each coordinate
    Vec3f ng;            ///< geometric normal, unit, on the side that the shape calls front
    Frame shading;       ///< shading.n: interpolated normal; shading.s: along dp/du where the surface has UVs
    glm::vec2 uv{0.0f};
    std::uint32_t geometry = 0;
};

namespace detail {

/// Barycentrics of the second and third vertex, clamped into the triangle (Embree has said that the ray hits it).
/// Source: signed volumes relative to the ray's origin, as in Woop et al. 2013, JCGT 2(1)
[[nodiscard]] inline glm::vec2 barycentrics(Vec3f v0, Vec3f v1, Vec3f v2, const Ray& ray) noexcept {
    const Vec3f a = v0 - ray.o, b = v1 - ray.o, c = v2 - ray.o;
    float w0 = dot(ray.d, cross(c, b)), w1 = dot(ray.d, cross(a, c)), w2 = dot(ray.d, cross(b, a));
    float sum = w0 + w1 + w2;
    if (sum < 0.0f) {
        w0 = -w0;
        w1 = -w1;
        w2 = -w2;
        sum = -sum;
    }
    w0 = w0 > 0.0f ? w0 : 0.0f;
    w1 = w1 > 0.0f ? w1 : 0.0f;
    w2 = w2 > 0.0f ? w2 : 0.0f;
    sum = w0 + w1 + w2;
    if (!(sum > 0.0f)) return {1.0f / 3.0f, 1.0f / 3.0f};  // the ray lies in the plane; any point of the triangle will do
    return {w1 / sum, w2 / sum};
}

/// Frame around n with s along dpdu as far as possible.
[[nodiscard]] inline Frame frame_along(Vec3f n, Vec3f dpdu) noexcept {
    const Vec3f s = dpdu - n * dot(n, dpdu);
    const float len2 = dot(s, s);
    if (!(len2 > 0.0f)) return Frame::from_normal(n);
    Frame f;
    f.n = n;
    f.s = s * (1.0f / std::sqrt(len2));
    f.t = cross(n, f.s);
    return f;
}

[[nodiscard]] inline glm::vec2 sphere_uv(Vec3d q) noexcept {
    // q is a unit vector from the centre; azimuth and polar angle as fractions
    float phi = atan2_poly(static_cast<float>(q.y), static_cast<float>(q.x));
    if (phi < 0.0f) phi += 2.0f * kPi;
    const auto rho = static_cast<float>(std::sqrt(q.x * q.x + q.y * q.y));
    return {phi * (0.5f * kInvPi), atan2_poly(rho, static_cast<float>(q.z)) * kInvPi};
}

}  // namespace detail

/// A point of a triangle by the barycentrics of its second and third vertex, with UVs, shading normal and tangent.
[[nodiscard]] inline Surface triangle_surface(const Scene& scene, std::uint32_t geometry, std::uint32_t triangle, glm::vec2 b) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const auto& index = scene.triangles[triangle];
    const Vec3f v0 = scene.positions[index[0]], v1 = scene.positions[index[1]], v2 = scene.positions[index[2]];
    const float b0 = 1.0f - b.x - b.y > 0.0f ? 1.0f - b.x - b.y : 0.0f;
    const Vec3f t0 = v0 * b0, t1 = v1 * b.x, t2 = v2 * b.y;
    Surface s;
    s.geometry = geometry;
    s.p = t0 + t1 + t2;
    s.p_error = (abs(t0) + abs(t1) + abs(t2)) * error_gamma(7);
    const Vec3f e1 = v1 - v0, e2 = v2 - v0;
    // Scaled before squaring: the product of two tiny edges would underflow.
    const float scale = 1.0f / max_component(Vec3f{max_component(abs(e1)), max_component(abs(e2)), 1e-30f});
    const Vec3f n = cross(e1 * scale, e2 * scale);
    const float len2 = dot(n, n);
    s.ng = len2 > 0.0f ? n * (1.0f / std::sqrt(len2)) : Vec3f{0.0f, 0.0f, 1.0f};
    Vec3f shading = s.ng;
    if (g.has_normals) {
        const Vec3f m = scene.normals[index[0]] * b0 + scene.normals[index[1]] * b.x + scene.normals[index[2]] * b.y;
        const float m2 = dot(m, m);
        if (m2 > 0.0f) shading = m * (1.0f / std::sqrt(m2));
    }
    if (g.flip) {
        s.ng = -s.ng;
        shading = -shading;
    }
    if (g.has_uvs) {
        const glm::vec2 uv0 = scene.uvs[index[0]], uv1 = scene.uvs[index[1]], uv2 = scene.uvs[index[2]];
        s.uv = {uv0.x * b0 + uv1.x * b.x + uv2.x * b.y, uv0.y * b0 + uv1.y * b.x + uv2.y * b.y};
        const float du1 = uv1.x - uv0.x, dv1 = uv1.y - uv0.y, du2 = uv2.x - uv0.x, dv2 = uv2.y - uv0.y;
        const float det = du1 * dv2 - dv1 * du2;
        if (det != 0.0f) {
            const float sign = det > 0.0f ? 1.0f : -1.0f;
            s.shading = detail::frame_along(shading, (e1 * dv2 - e2 * dv1) * sign);
            return s;
        }
    } else {
        s.uv = b;
    }
    s.shading = Frame::from_normal(shading);
    return s;
}

/// A point of a sphere in direction q from its centre (q of length about radius).
[[nodiscard]] inline Surface sphere_surface(const Scene& scene, std::uint32_t geometry, Vec3d q) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const AnalyticSphere& sphere = scene.spheres[g.first];
    const Vec3d unit = q * (1.0 / std::sqrt(dot(q, q)));
    Surface s;
    s.geometry = geometry;
    s.p = to_float(sphere.center + unit * sphere.radius);
    s.p_error = abs(s.p) * error_gamma(2);  // computed in double: the rounding to float is what is left
    s.ng = to_float(g.flip ? -unit : unit);
    s.uv = detail::sphere_uv(unit);
    const Vec3f dpdu{-static_cast<float>(unit.y), static_cast<float>(unit.x), 0.0f};
    s.shading = detail::frame_along(s.ng, dpdu);
    return s;
}

/// A point of a disk in the disk's own coordinates.
[[nodiscard]] inline Surface disk_surface(const Scene& scene, std::uint32_t geometry, double x, double y) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const AnalyticDisk& disk = scene.disks[g.first];
    const Vec3d n = cross(disk.s, disk.t);
    Surface s;
    s.geometry = geometry;
    s.p = to_float(disk.center + disk.s * x + disk.t * y);
    s.p_error = abs(s.p) * error_gamma(2);
    s.ng = to_float(n * ((g.flip ? -1.0 : 1.0) / std::sqrt(dot(n, n))));
    const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
    float phi = atan2_poly(fy, fx);
    if (phi < 0.0f) phi += 2.0f * kPi;
    const float r = std::sqrt(fx * fx + fy * fy);
    s.uv = {r, phi * (0.5f * kInvPi)};
    s.shading = detail::frame_along(s.ng, r > 0.0f ? to_float(disk.s) * fx + to_float(disk.t) * fy : to_float(disk.s));
    return s;
}

/// @param hit  what the accelerator answered for this ray
template <EffectSet kEffects>
[[nodiscard]] Surface surface_at(const Scene& scene, const Ray& ray, Hit hit) noexcept {
    const GeometryRecord& g = scene.geometries[hit.geometry];
    if constexpr (kEffects.has(Effect::analytic_shape)) {
        if (g.kind == GeometryKind::sphere) {
            const AnalyticSphere& sphere = scene.spheres[g.first];
            const double t = intersect(sphere, ray);
            return sphere_surface(scene, hit.geometry, to_double(ray.o) + to_double(ray.d) * t - sphere.center);
        }
        if (g.kind == GeometryKind::disk) {
            const DiskHit d = intersect(scene.disks[g.first], ray);
            return disk_surface(scene, hit.geometry, d.x, d.y);
        }
    }
    const std::uint32_t triangle = g.first + hit.primitive;
    const auto& index = scene.triangles[triangle];
    return triangle_surface(scene, hit.geometry, triangle,
                            detail::barycentrics(scene.positions[index[0]], scene.positions[index[1]], scene.positions[index[2]], ray));
}

/// The value of a texture at a surface.
template <EffectSet kEffects>
[[nodiscard]] Vec3f texture_value(const Scene& scene, const TextureRef& ref, glm::vec2 uv) noexcept {
    if constexpr (kEffects.has(Effect::texture))
        if (ref.index >= 0) return lookup(scene.textures[static_cast<std::size_t>(ref.index)], uv);
    return ref.constant;
}

/// The BSDF seen from wo (world), textures looked up, in a frame that looks toward the side which wo is on.
struct LocalBsdf {
    Bsdf bsdf;
    Frame frame;  ///< turned over where a two-sided material is seen from behind
};

template <EffectSet kEffects>
[[nodiscard]] LocalBsdf bsdf_at(const Scene& scene, const Surface& s, Vec3f wo) noexcept {
    const MaterialSides& sides = scene.materials[scene.geometries[s.geometry].material];
    LocalBsdf out{{}, s.shading};
    std::uint32_t side_index = sides.front;
    if constexpr (kEffects.has(Effect::two_sided))
        if (sides.two_sided && dot(wo, s.shading.n) < 0.0f) {
            side_index = sides.back;
            out.frame.n = -out.frame.n;
            out.frame.t = -out.frame.t;
        }
    const MaterialSide& m = scene.sides[side_index];
    out.bsdf.kind = m.kind;
    out.bsdf.reflectance = texture_value<kEffects>(scene, m.reflectance, s.uv);
    if constexpr (kEffects.has(Effect::glossy) || kEffects.has(Effect::specular) || kEffects.has(Effect::dielectric)) {
        out.bsdf.perfect = m.perfect;
        out.bsdf.transmittance = m.transmittance;
        out.bsdf.eta = m.eta;
        out.bsdf.k = m.k;
    }
    if constexpr (kEffects.has(Effect::glossy))
        if (m.kind == BsdfKind::rough_conductor) {
            const float au = texture_value<kEffects>(scene, m.alpha_u, s.uv).x, av = texture_value<kEffects>(scene, m.alpha_v, s.uv).x;
            out.bsdf.facets = {au > 1e-4f ? au : 1e-4f, av > 1e-4f ? av : 1e-4f, m.ggx};
        }
    return out;
}

}  // namespace koksma
