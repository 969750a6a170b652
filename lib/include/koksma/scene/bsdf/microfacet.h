#pragma once
// Beckmann and GGX normal distributions with Smith's uncorrelated masking-shadowing, G(wo, wi) = G1(wo) G1(wi).
// The uncorrelated form is the one of Walter et al. 2007 and of Mitsuba; single scattering, so it loses energy as roughness grows.
// All directions are local (normal +z).

#include <koksma/math/vec3.h>
#include <koksma/simd/elementary.h>

#include <glm/vec2.hpp>

#include <cmath>

namespace koksma {

struct Microfacet {
    float alpha_u = 0.1f, alpha_v = 0.1f;  ///< [1e-4, inf)
    bool ggx = false;

    /// Density of normals, per steradian; the slope form keeps its precision down to alpha = 1e-4.
    [[nodiscard]] float d(Vec3f h) const noexcept {
        if (!(h.z > 0.0f)) return 0.0f;
        const float x = h.x / alpha_u, y = h.y / alpha_v;
        const float norm = kPi * alpha_u * alpha_v;
        if (ggx) {
            const float k = x * x + y * y + h.z * h.z;
            return 1.0f / (norm * k * k);
        }
        const float cos2 = h.z * h.z;
        return exp_poly(-(x * x + y * y) / cos2) / (norm * cos2 * cos2);
    }

    /// Smith's masking of direction w by facets of normal h, [0, 1].
    /// Source: Walter et al. 2007, equations 27 (Beckmann, rational fit) and 34 (GGX)
    [[nodiscard]] float g1(Vec3f w, Vec3f h) const noexcept {
        if (!(dot(w, h) * w.z > 0.0f)) return 0.0f;
        const float sx = alpha_u * w.x, sy = alpha_v * w.y;
        const float slope2 = sx * sx + sy * sy;
        const float z = std::fabs(w.z);
        if (ggx) return 2.0f * z / (z + std::sqrt(z * z + slope2));
        if (slope2 * 2.56f <= z * z) return 1.0f;
        const float a = z / std::sqrt(slope2);
        return (3.535f * a + 2.181f * a * a) / (1.0f + 2.276f * a + 2.577f * a * a);
    }

    /// Samples a normal: visible ones for GGX, all for Beckmann.
    /// @param wo  wo.z > 0
    /// @return    unit, z > 0; density pdf(wo, h)
    /// Source: GGX: Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps"
    [[nodiscard]] Vec3f sample(Vec3f wo, glm::vec2 u) const noexcept {
        const SinCos sc = sincos_turns(u.x);
        if (!ggx) {
            const float r = std::sqrt(-log_poly(1.0f - u.y));
            return normalize(Vec3f{alpha_u * r * sc.cos, alpha_v * r * sc.sin, 1.0f});
        }
        const Vec3f w = normalize(Vec3f{wo.x * alpha_u, wo.y * alpha_v, wo.z});
        const float z = (1.0f - u.y) * (1.0f + w.z) - w.z;
        const float s2 = 1.0f - z * z;
        const float s = std::sqrt(s2 > 0.0f ? s2 : 0.0f);
        const Vec3f c{s * sc.cos + w.x, s * sc.sin + w.y, z + w.z};
        return normalize(Vec3f{c.x * alpha_u, c.y * alpha_v, c.z > 1e-12f ? c.z : 1e-12f});
    }
    /// Density of sample(), per steradian of h.
    [[nodiscard]] float pdf(Vec3f wo, Vec3f h) const noexcept {
        if (!ggx) return d(h) * h.z;
        const float c = dot(wo, h);
        return c > 0.0f ? g1(wo, h) * c * d(h) / wo.z : 0.0f;
    }
};

}  // namespace koksma
