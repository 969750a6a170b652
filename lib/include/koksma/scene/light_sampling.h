#pragma once
// Emission, and how lights are sampled: position and density always by the same expressions, so that MIS weights add up to one.

#include <koksma/scene/light_maths.h>
#include <koksma/scene/surface.h>

namespace koksma {

/// A direction toward a light as drawn by light sampling; pdf_w == 0 means that there is none.
struct LightSample {
    Vec3f wi;                 ///< unit, from the shaded point
    Vec3f radiance;           ///< arriving along wi if nothing is in between (point lights: intensity / distance^2)
    float pdf_w = 0.0f;       ///< per steradian, of this light (its choice not included); 1 for a delta light
    bool delta = false;
    bool at_infinity = false;
    Vec3f target;             ///< end of the shadow ray, already moved off the light's surface
};

/// Radiance that leaves a surface toward wo. Zero from behind.
template <EffectSet kEffects>
[[nodiscard]] Vec3f emitted(const Scene& scene, const Surface& s, Vec3f wo) noexcept {
    const std::int32_t light = scene.geometries[s.geometry].light;
    if (light < 0 || !(dot(wo, s.n) > 0.0f)) return Vec3f{0.0f};
    return texture_value<kEffects>(scene, scene.lights[static_cast<std::size_t>(light)].radiance, s.uv);
}

/// What arrives from infinity, and with which density sample_light draws the direction.
using EnvironmentValue = EnvironmentValueOf<float>;

/// @pre there is an environment
[[nodiscard]] inline EnvironmentValue environment_value(const Scene& scene, Vec3f d) noexcept {
    if (!scene.environment_map) return {scene.lights[static_cast<std::size_t>(scene.environment_light)].radiance.constant, 0.25f * kInvPi};
    const EnvironmentTable table = scene.environment_map->table();
    return environment_at(table, environment_place(table, d));
}

/// A sphere is sampled by the cone that it fills, from outside; one that shines inwards, by area.
[[nodiscard]] inline bool sampled_by_cone(const Scene& scene, const Light& light) noexcept { return !scene.geometries[light.geometry].flip; }

/// 1 - cos of the half angle of the cone that a sphere fills seen from p; 0 from inside.
[[nodiscard]] inline float sphere_cone(const AnalyticSphere& sphere, Vec3f p) noexcept {
    const Vec3d to_center = sphere.center - to_double(p);
    const double d2 = dot(to_center, to_center), r2 = sphere.radius * sphere.radius;
    if (!(d2 > r2)) return 0.0f;
    const double sin2 = r2 / d2;
    return static_cast<float>(sin2 / (1.0 + std::sqrt(1.0 - sin2)));
}

/// Density with which sample_light would have drawn the direction from p to the surface s of this light (or of this triangle).
template <EffectSet kEffects>
[[nodiscard]] float light_pdf(const Scene& scene, const Light& light, Vec3f p, const Surface& s, Vec3f wi,
                              std::uint32_t triangle = kWholeLight) noexcept {
    if constexpr (kEffects.has(Effect::sphere_light))
        if (light.kind == LightKind::sphere && sampled_by_cone(scene, light)) {
            const float h = sphere_cone(scene.spheres[scene.geometries[light.geometry].first], p);
            return h > 0.0f ? 1.0f / (2.0f * kPi * h) : 0.0f;
        }
    const Vec3f d = s.p - p;
    return area_to_solid_angle(dot(d, d), std::fabs(dot(s.ng, wi)), light.area_of(triangle));
}

namespace detail {

/// Completes a sample whose point on the light (or on this triangle) is known.
template <EffectSet kEffects>
[[nodiscard]] LightSample toward(const Scene& scene, const Light& light, const Surface& s, Vec3f p, float pdf_cone,
                                 std::uint32_t triangle = kWholeLight) noexcept {
    const Vec3f d = s.p - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return {};
    LightSample out;
    out.wi = d * (1.0f / std::sqrt(d2));
    if (!(dot(out.wi, s.n) < 0.0f)) return {};
    out.pdf_w = pdf_cone > 0.0f ? pdf_cone : area_to_solid_angle(d2, std::fabs(dot(s.ng, out.wi)), light.area_of(triangle));
    out.radiance = texture_value<kEffects>(scene, light.radiance, s.uv);
    out.target = shadow_target(s.p, s.p_error, s.ng, std::sqrt(d2), -d);
    return out;
}

/// A spot or a projector as seen from p: a point whose intensity depends on the direction.
template <EffectSet kEffects>
[[nodiscard]] LightSample from_beam(const Scene& scene, const Light& light, Vec3f p) noexcept {
    const Beam& beam = scene.beams[light.geometry];
    const Vec3f d = light.corner - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return {};
    const float distance = std::sqrt(d2);
    const Vec3f wi = d * (1.0f / distance);
    const Vec3f own{-dot(beam.right, wi), -dot(beam.up, wi), -dot(beam.forward, wi)};
    float factor = 1.0f / d2;
    const float x = own.x / (own.z * beam.half_width), y = own.y / (own.z * beam.half_height);
    Vec2f uv{0.5f + 0.5f * x, 0.5f + 0.5f * y};
    if (light.kind == LightKind::spot) {
        const float cosine = own.z / std::sqrt(dot(own, own));
        if (!(cosine > beam.cos_cutoff)) return {};
        if (cosine < beam.cos_beam) {
            const float sine2 = 1.0f - cosine * cosine;
            const float falloff = (beam.cutoff - atan2_poly(std::sqrt(sine2 > 0.0f ? sine2 : 0.0f), cosine)) * beam.inverse_transition;
            if (!(falloff > 0.0f)) return {};
            factor *= falloff < 1.0f ? falloff : 1.0f;
        }
    } else {
        // The picture as a camera sees it: u counts to the right, v down. 1/cos^3 makes a plane before it evenly lit.
        if (!(own.z > 0.0f && x >= -1.0f && x <= 1.0f && y >= -1.0f && y <= 1.0f)) return {};
        uv = {0.5f - 0.5f * x, 0.5f - 0.5f * y};
        factor /= own.z * own.z * own.z;
    }
    return {wi, texture_value<kEffects>(scene, light.radiance, uv) * light.edge_u * factor, 1.0f, true, false, light.corner};
}

}  // namespace detail

/// Draws a direction toward a light as seen from p.
/// @param only  one triangle of a mesh, as choose_light names it
template <EffectSet kEffects>
[[nodiscard]] LightSample sample_light(const Scene& scene, const Light& light, Vec3f p, Vec2f u, std::uint32_t only = kWholeLight) noexcept {
    if constexpr (kEffects.has(Effect::point_light))
        if (light.kind == LightKind::point) {
            const Vec3f d = light.corner - p;
            const float d2 = dot(d, d);
            if (!(d2 > 0.0f)) return {};
            return {d * (1.0f / std::sqrt(d2)), light.radiance.constant / d2, 1.0f, true, false, light.corner};
        }
    if constexpr (kEffects.has(Effect::point_light)) {
        if (light.kind == LightKind::directional) return {light.corner, light.radiance.constant, 1.0f, true, true, light.corner};
        if (light.kind == LightKind::spot || light.kind == LightKind::projector) return detail::from_beam<kEffects>(scene, light, p);
    }
    if constexpr (kEffects.has(Effect::environment))
        if (light.kind == LightKind::environment) {
            if (!scene.environment_map) {
                const Vec3f d = square_to_sphere(u);
                return {d, light.radiance.constant, 0.25f * kInvPi, false, true, d};
            }
            if (scene.environment_map->is_black()) return {};
            const Vec3f d = environment_direction(scene.environment_map->cells(), u);
            const EnvironmentValue value = environment_value(scene, d);
            if (!(value.pdf_w > 0.0f)) return {};
            return {d, value.radiance, value.pdf_w, false, true, d};
        }
    if constexpr (kEffects.has(Effect::sphere_light))
        if (light.kind == LightKind::sphere) {
            const AnalyticSphere& sphere = scene.spheres[scene.geometries[light.geometry].first];
            if (!sampled_by_cone(scene, light)) {
                const Vec3f q = square_to_sphere(u);
                return detail::toward<kEffects>(scene, light, sphere_surface<kEffects>(scene, light.geometry, to_double(q)), p, 0.0f);
            }
            const float h = sphere_cone(sphere, p);
            if (!(h > 0.0f)) return {};
            const Vec3d to_center = sphere.center - to_double(p);
            const double distance = std::sqrt(dot(to_center, to_center));
            const Vec3f local = square_to_cone(u, h);
            const Vec3f wi = Frame::from_normal(to_float(to_center * (1.0 / distance))).to_world(local);
            // The nearer intersection along wi, by the law of sines about the centre; grazing directions touch at one point.
            const double cos_d = local.z, sin2_d = static_cast<double>(local.x) * local.x + static_cast<double>(local.y) * local.y;
            const double half_chord2 = sphere.radius * sphere.radius - distance * distance * sin2_d;
            const double t = distance * cos_d - std::sqrt(half_chord2 > 0.0 ? half_chord2 : 0.0);
            const Surface s = sphere_surface<kEffects>(scene, light.geometry, to_double(wi) * t - to_center);
            LightSample out;
            out.wi = wi;
            out.pdf_w = 1.0f / (2.0f * kPi * h);
            out.radiance = texture_value<kEffects>(scene, light.radiance, s.uv);
            out.target = shadow_target(s.p, s.p_error, s.ng, static_cast<float>(t), s.ng);
            return out;
        }
    if constexpr (kEffects.has(Effect::area_light)) {
        if (light.kind == LightKind::parallelogram || light.kind == LightKind::mesh) {
            std::uint32_t triangle = 0;
            Vec2f b;
            if (light.kind == LightKind::parallelogram) {
                // Two triangles (0, 1, 2) and (0, 2, 3) over corners in circular order: the square maps without a seam.
                if (u.x >= u.y) {
                    b = {u.x - u.y, u.y};
                } else {
                    triangle = 1;
                    b = {u.x, u.y - u.x};
                }
            } else {
                if (only != kWholeLight) {
                    triangle = only;
                } else if (light.triangles.size() > 1) {
                    const DiscreteSample t = light.triangles.sample(u.x);
                    triangle = t.index;
                    u.x = t.u;
                }
                b = square_to_triangle(u);
            }
            const Surface s = triangle_surface<kEffects>(scene, light.geometry, scene.geometries[light.geometry].first + triangle, b);
            return detail::toward<kEffects>(scene, light, s, p, 0.0f, only);
        }
        if constexpr (kEffects.has(Effect::analytic_shape))
            if (light.kind == LightKind::disk) {
                const Vec2f q = square_to_disk(u);
                return detail::toward<kEffects>(scene, light, disk_surface<kEffects>(scene, light.geometry, q.x, q.y), p, 0.0f);
            }
        if constexpr (kEffects.has(Effect::analytic_shape))
            if (light.kind == LightKind::cylinder) {
                const auto [sine, cosine] = sincos_turns(u.x);
                return detail::toward<kEffects>(scene, light, cylinder_surface<kEffects>(scene, light.geometry, cosine, sine, u.y), p, 0.0f);
            }
    }
    return {};
}

}  // namespace koksma
