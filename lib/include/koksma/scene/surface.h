#pragma once
// The point that a ray met, recomputed from the scene's own data.

#include <koksma/scene/instance.h>
#include <koksma/scene/scene.h>
#include <koksma/scene/triangle.h>

#include <algorithm>
#include <limits>

namespace koksma {

struct Surface {
    Vec3f p;             ///< in the plane of the triangle (a convex combination of its vertices) or on the shape
    Vec3f p_error;       ///< bound of the absolute error of each coordinate
    Vec3f ng;            ///< geometric normal, unit, on the side that the shape calls front
    Vec3f n;             ///< shading normal: interpolated where the mesh has normals
    SurfaceUv uv;        ///< only where an effect looks at it
    Vec3f dpdu{0.0f};    ///< direction in which u grows, up to its length; only for anisotropic materials, and zero without UVs
    std::uint32_t geometry = 0, primitive = 0;
    std::uint32_t instance = Hit::kNone;
    float time = 0.0f;  ///< of the ray, where it met an instance
};

namespace detail {

[[nodiscard]] inline Vec2f sphere_uv(Vec3d q) noexcept {
    // q is a unit vector from the centre; azimuth and polar angle as fractions
    float phi = atan2_poly(static_cast<float>(q.y), static_cast<float>(q.x));
    if (phi < 0.0f) phi += 2.0f * kPi;
    const auto rho = static_cast<float>(std::sqrt(q.x * q.x + q.y * q.y));
    return {phi * (0.5f * kInvPi), atan2_poly(rho, static_cast<float>(q.z)) * kInvPi};
}

}  // namespace detail

/// A hit point and the bound of its coordinates' errors.
struct RefinedPoint {
    Vec3f p, p_error;
};

/// The point of a triangle's border that is nearest to q.
[[nodiscard]] inline Vec3d nearest_on_border(Vec3d v0, Vec3d v1, Vec3d v2, Vec3d q) noexcept {
    const Vec3d corners[] = {v0, v1, v2};
    Vec3d best = v0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const Vec3d p = corners[i], edge = corners[(i + 1) % 3] - p;
        const double e2 = dot(edge, edge), along = e2 > 0.0 ? dot(q - p, edge) / e2 : 0.0;
        const Vec3d at = p + edge * (along > 0.0 ? (along < 1.0 ? along : 1.0) : 0.0), off = at - q;
        if (dot(off, off) < least) {
            least = dot(off, off);
            best = at;
        }
    }
    return best;
}

/// Where the ray meets the plane of a triangle, in double; the nearest point of the triangle where that is beyond it by more than Embree's own
/// rounding, as with slivers of which Embree says that a ray nearly in their plane hits them while it passes by.
/// @return  the point given, where the ray lies in the plane
[[nodiscard]] inline RefinedPoint refined_point(Vec3f v0, Vec3f v1, Vec3f v2, Vec3f o, Vec3f d, RefinedPoint coarse) noexcept {
    const Vec3d origin = to_double(o), a = to_double(v0) - origin, b = to_double(v1) - origin, c = to_double(v2) - origin, direction = to_double(d);
    const double w0 = dot(direction, cross(c, b)), w1 = dot(direction, cross(a, c)), w2 = dot(direction, cross(b, a)), sum = w0 + w1 + w2;
    if (sum == 0.0) return coarse;
    Vec3d q = (a * w0 + b * w1 + c * w2) * (1.0 / sum);
    if (!(w0 * sum >= 0.0 && w1 * sum >= 0.0 && w2 * sum >= 0.0)) {
        const Vec3d inside = nearest_on_border(a, b, c, q);
        const double rounding = double{error_gamma(16)} * std::sqrt(std::max({dot(a, a), dot(b, b), dot(c, c)})) + max_component(coarse.p_error);
        if (!(length(q - inside) <= rounding)) q = inside;
    }
    const Vec3f p = to_float(origin + q);
    return {p, abs(p) * error_gamma(2)};  // computed in double: the rounding to float is what is left
}

/// The normal of a needle, in double. @return  `otherwise` where the triangle has no area
[[nodiscard]] inline Vec3f normal_of_needle(Vec3f v0, Vec3f v1, Vec3f v2, Vec3f otherwise) noexcept {
    const Vec3d n = cross(to_double(v1) - to_double(v0), to_double(v2) - to_double(v0));
    const double len2 = dot(n, n);
    return len2 > 0.0 ? to_float(n * (1.0 / std::sqrt(len2))) : otherwise;
}

/// The geometric normal of a triangle, before it may be turned.
[[nodiscard]] inline Vec3f normal_of_triangle(Vec3f v0, Vec3f v1, Vec3f v2) noexcept {
    const Vec3f n = triangle_normal(v0, v1, v2);
    return is_needle(v0, v1, v2) ? normal_of_needle(v0, v1, v2, n) : n;
}

/// A point of a triangle by the barycentrics of its second and third vertex.
template <EffectSet kEffects>
[[nodiscard]] Surface triangle_surface(const Scene& scene, std::uint32_t geometry, std::uint32_t triangle, Vec2f b) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const auto& index = scene.triangles[triangle];
    const Vec3f v0 = scene.positions[index[0]], v1 = scene.positions[index[1]], v2 = scene.positions[index[2]];
    const TrianglePointOf<float> point = triangle_point(v0, v1, v2, b);
    Surface s;
    s.geometry = geometry;
    s.primitive = triangle - g.first;
    s.p = point.p;
    s.p_error = point.p_error;
    s.ng = s.n = normal_of_triangle(v0, v1, v2);
    if constexpr (kEffects.has(Effect::shading_normals))
        if (g.has_normals) s.n = interpolated_normal(scene.normals[index[0]], scene.normals[index[1]], scene.normals[index[2]], point.b0, b, s.ng);
    if (g.flip) {
        s.ng = -s.ng;
        s.n = -s.n;
    }
    if constexpr (kEffects.has(Effect::texture) || kEffects.has(Effect::anisotropic)) {
        s.uv = b;
        if (g.has_uvs) {
            const Vec2f uv0 = scene.uvs[index[0]], uv1 = scene.uvs[index[1]], uv2 = scene.uvs[index[2]];
            s.uv = Vec2f{uv0.x * point.b0 + uv1.x * b.x + uv2.x * b.y, uv0.y * point.b0 + uv1.y * b.x + uv2.y * b.y};
            if constexpr (kEffects.has(Effect::anisotropic)) s.dpdu = direction_of_u(v0, v1, v2, uv0, uv1, uv2);
        }
    }
    if constexpr (kEffects.has(Effect::mesh_attribute)) {
        s.uv.triangle = triangle;
        s.uv.barycentrics = b;
    }
    return s;
}

/// A point of a sphere in direction q from its centre (q of length about radius).
template <EffectSet kEffects>
[[nodiscard]] Surface sphere_surface(const Scene& scene, std::uint32_t geometry, Vec3d q) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const AnalyticSphere& sphere = scene.spheres[g.first];
    const Vec3d unit = q * (1.0 / std::sqrt(dot(q, q)));
    Surface s;
    s.geometry = geometry;
    s.p = to_float(sphere.center + unit * sphere.radius);
    s.p_error = abs(s.p) * error_gamma(2);  // computed in double: the rounding to float is what is left
    s.ng = s.n = to_float(g.flip ? -unit : unit);
    if constexpr (kEffects.has(Effect::texture)) s.uv = detail::sphere_uv(unit);
    if constexpr (kEffects.has(Effect::anisotropic)) s.dpdu = {-static_cast<float>(unit.y), static_cast<float>(unit.x), 0.0f};
    return s;
}

/// A point of a disk in the disk's own coordinates.
template <EffectSet kEffects>
[[nodiscard]] Surface disk_surface(const Scene& scene, std::uint32_t geometry, double x, double y) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const AnalyticDisk& disk = scene.disks[g.first];
    const Vec3d n = cross(disk.s, disk.t);
    Surface s;
    s.geometry = geometry;
    s.p = to_float(disk.center + disk.s * x + disk.t * y);
    s.p_error = abs(s.p) * error_gamma(2);
    s.ng = s.n = to_float(n * ((g.flip ? -1.0 : 1.0) / std::sqrt(dot(n, n))));
    if constexpr (kEffects.has(Effect::texture) || kEffects.has(Effect::anisotropic)) {
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
        float phi = atan2_poly(fy, fx);
        if (phi < 0.0f) phi += 2.0f * kPi;
        const float r = std::sqrt(fx * fx + fy * fy);
        s.uv = Vec2f{r, phi * (0.5f * kInvPi)};
        s.dpdu = r > 0.0f ? to_float(disk.s) * fx + to_float(disk.t) * fy : to_float(disk.s);
    }
    return s;
}

/// A point of a cylinder in its own coordinates: direction from the axis (a unit vector), way along it in [0, 1].
template <EffectSet kEffects>
[[nodiscard]] Surface cylinder_surface(const Scene& scene, std::uint32_t geometry, double cosine, double sine, double along) noexcept {
    const GeometryRecord& g = scene.geometries[geometry];
    const AnalyticCylinder& c = scene.cylinders[g.first];
    const Vec3d out = c.s * cosine + c.t * sine;
    Surface s;
    s.geometry = geometry;
    s.p = to_float(c.base + c.axis * along + out * c.radius);
    s.p_error = abs(s.p) * error_gamma(2);
    s.ng = s.n = to_float(g.flip ? -out : out);
    if constexpr (kEffects.has(Effect::texture)) {
        float phi = atan2_poly(static_cast<float>(sine), static_cast<float>(cosine));
        if (phi < 0.0f) phi += 2.0f * kPi;
        s.uv = Vec2f{phi * (0.5f * kInvPi), static_cast<float>(along)};
    }
    if constexpr (kEffects.has(Effect::anisotropic)) s.dpdu = to_float(c.t * cosine - c.s * sine);
    return s;
}

namespace detail {

/// @tparam kSure  the ray is not quite the one that the accelerator had
template <EffectSet kEffects, bool kSure>
[[nodiscard]] Surface own_surface_at(const Scene& scene, const Ray& ray, Hit hit) noexcept {
    const auto where = [&](const auto& shape) {
        if constexpr (kSure)
            return meet(shape, ray);
        else
            return intersect(shape, ray);
    };
    const GeometryRecord& g = scene.geometries[hit.geometry];
    if constexpr (kEffects.has(Effect::analytic_shape)) {
        if (g.kind == GeometryKind::sphere) {
            const AnalyticSphere& sphere = scene.spheres[g.first];
            const double t = where(sphere);
            return sphere_surface<kEffects>(scene, hit.geometry, to_double(ray.o) + to_double(ray.d) * t - sphere.center);
        }
        if (g.kind == GeometryKind::disk) {
            const DiskHit d = where(scene.disks[g.first]);
            return disk_surface<kEffects>(scene, hit.geometry, d.x, d.y);
        }
        if (g.kind == GeometryKind::cylinder) {
            const CylinderHit c = where(scene.cylinders[g.first]);
            return cylinder_surface<kEffects>(scene, hit.geometry, c.cosine, c.sine, c.along);
        }
    }
    const std::uint32_t triangle = g.first + hit.primitive;
    const auto& index = scene.triangles[triangle];
    const Vec3f v0 = scene.positions[index[0]], v1 = scene.positions[index[1]], v2 = scene.positions[index[2]];
    Surface s = triangle_surface<kEffects>(scene, hit.geometry, triangle, barycentrics(v0, v1, v2, ray.o, ray.d));
    if (is_coarse(s.p, s.p_error, ray.o) || is_needle(v0, v1, v2)) {
        const RefinedPoint r = refined_point(v0, v1, v2, ray.o, ray.d, {s.p, s.p_error});
        s.p = r.p;
        s.p_error = r.p_error;
    }
    return s;
}

/// A point of a group, found in the group's own space and brought to the scene's with its bound. Not inlined: GCC 12 was seen to skip the
/// rounding of the group's own ray to float in one kernel and not in another.
[[nodiscard]] Surface instanced_surface_at(const Scene& scene, const Ray& ray, Hit hit) noexcept;

}  // namespace detail

/// @param hit  what closest_hit() answered for this ray
template <EffectSet kEffects>
[[nodiscard]] Surface surface_at(const Scene& scene, const Ray& ray, Hit hit) noexcept {
    if constexpr (kEffects.has(Effect::instancing))
        if (hit.instance != Hit::kNone) return detail::instanced_surface_at(scene, ray, hit);
    return detail::own_surface_at<kEffects, false>(scene, ray, hit);
}

namespace detail {

/// Of a face, or interpolated between the vertices.
[[nodiscard]] inline Vec3f attribute_value(const Scene& scene, const AttributeSlot& slot, const SurfaceUv& at) noexcept {
    const std::vector<Vec3f>& values = scene.attributes[static_cast<std::size_t>(slot.index)];
    if (slot.per_face) return values[at.triangle] * slot.scale;
    const auto& index = scene.triangles[at.triangle];
    const Vec2f b = at.barycentrics;
    return (values[index[0]] * (1.0f - b.x - b.y) + values[index[1]] * b.x + values[index[2]] * b.y) * slot.scale;
}

}  // namespace detail

/// The value of a texture at a surface.
template <EffectSet kEffects>
[[nodiscard]] Vec3f texture_value(const Scene& scene, const TextureRef& ref, const SurfaceUv& uv) noexcept {
    if constexpr (kEffects.has(Effect::texture))
        if (ref.index >= 0) {
            const auto index = static_cast<std::size_t>(ref.index);
            if constexpr (kEffects.has(Effect::mesh_attribute))
                if (const AttributeSlot& slot = scene.attribute_slots[index]; slot.index >= 0) return detail::attribute_value(scene, slot, uv);
            return lookup(scene.textures[index], {uv.x, uv.y});
        }
    return ref.constant;
}

/// One side of a material with its textures looked up. Of layered sides the kind alone: layered.h computes them.
template <EffectSet kEffects>
[[nodiscard]] Bsdf bsdf_of(const Scene& scene, const MaterialSide& m, const SurfaceUv& uv) noexcept {
    Bsdf b;
    b.kind = m.kind;
    b.reflectance = texture_value<kEffects>(scene, m.reflectance, uv);
    if constexpr (kEffects.has(Effect::glossy) || kEffects.has(Effect::specular) || kEffects.has(Effect::dielectric)) {
        b.perfect = m.perfect;
        b.transmittance = m.transmittance;
        b.eta = m.eta;
        b.k = m.k;
    }
    if constexpr (kEffects.has(Effect::glossy))
        if (m.kind == BsdfKind::rough_conductor) {
            const float au = texture_value<kEffects>(scene, m.alpha_u, uv).x, av = texture_value<kEffects>(scene, m.alpha_v, uv).x;
            b.facets = {au > 1e-4f ? au : 1e-4f, av > 1e-4f ? av : 1e-4f, m.ggx};
        }
    return b;
}

/// The BSDF seen from wo (world), textures looked up, in a frame that looks toward the side which wo is on.
struct LocalBsdf {
    Bsdf bsdf;
    Frame frame;           ///< turned over where a two-sided material is seen from behind
    LayeredPoint layered;  ///< of layered materials
};

template <EffectSet kEffects>
[[nodiscard]] LocalBsdf bsdf_at(const Scene& scene, const Surface& s, Vec3f wo) noexcept {
    const MaterialSides& sides = scene.materials[scene.geometries[s.geometry].material];
    LocalBsdf out{{}, Frame::from_normal(s.n), {}};
    if constexpr (kEffects.has(Effect::anisotropic))
        if (sides.anisotropic) out.frame = frame_along(s.n, s.dpdu);
    std::uint32_t side_index = sides.front;
    if constexpr (kEffects.has(Effect::two_sided))
        if (sides.two_sided && dot(wo, s.n) < 0.0f) {
            side_index = sides.back;
            out.frame.n = -out.frame.n;
            out.frame.t = -out.frame.t;
        }
    out.bsdf = bsdf_of<kEffects>(scene, scene.sides[side_index], s.uv);
    if constexpr (kEffects.has(Effect::layered)) out.layered = {side_index, s.uv, s.n, s.geometry, s.primitive, s.instance, s.time};
    return out;
}

/// As eval_bsdf and sample_bsdf, of any material.
template <EffectSet kEffects>
[[nodiscard]] BsdfValue eval_local(const Scene& scene, const LocalBsdf& local, Vec3f wo_local, Vec3f wi_local) noexcept {
    if constexpr (kEffects.has(Effect::layered))
        if (is_layered(local.bsdf)) return eval_layered(scene, local.layered, wo_local, wi_local);
    return eval_bsdf<kEffects>(local.bsdf, wo_local, wi_local);
}
template <EffectSet kEffects>
[[nodiscard]] BsdfSample sample_local(const Scene& scene, const LocalBsdf& local, Vec3f wo_local, float u_lobe, Vec2f u) noexcept {
    if constexpr (kEffects.has(Effect::layered))
        if (is_layered(local.bsdf)) return sample_layered(scene, local.layered, wo_local, u_lobe, u);
    return sample_bsdf<kEffects>(local.bsdf, wo_local, u_lobe, u);
}
/// The normal by which lights are chosen for a point.
template <EffectSet kEffects>
[[nodiscard]] Vec3f lit_normal_of(const LocalBsdf& local, Vec3f wo_local) noexcept {
    if constexpr (kEffects.has(Effect::layered)) return lit_normal(local.bsdf, local.frame.n, wo_local.z);
    return local.frame.n;
}

}  // namespace koksma
