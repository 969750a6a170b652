// Beckmann and GGX normal distributions with Smith's uncorrelated masking-shadowing, G(wo, wi) = G1(wo) G1(wi).
// The uncorrelated form is the one of Walter et al. 2007 and of Mitsuba; single scattering, so it loses energy as roughness grows.
// All directions are local (normal +z).

#include <koksma/math/vec3.h>
#include <koksma/simd/elementary.h>

#if defined(KOKSMA_SCENE_BSDF_MICROFACET_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_BSDF_MICROFACET_H
#undef KOKSMA_SCENE_BSDF_MICROFACET_H
#else
#define KOKSMA_SCENE_BSDF_MICROFACET_H
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
struct MicrofacetOf {
    Real alpha_u{}, alpha_v{};  ///< [1e-4, inf)
    MaskOf<Real> ggx{};

    /// Density of normals, per steradian; the slope form keeps its precision down to alpha = 1e-4.
    [[nodiscard]] Real d(Vec3<Real> h) const noexcept {
        const Real x = h.x / alpha_u, y = h.y / alpha_v;
        const Real norm = Real(kPi) * alpha_u * alpha_v;
        const Real cos2 = h.z * h.z;
        Real density{};
        if (any(ggx)) {
            const Real k = x * x + y * y + cos2;
            density = Real(1.0f) / (norm * k * k);
        }
        if (const auto beckmann = !ggx; any(beckmann))
            density = select(beckmann, exp_poly(-(x * x + y * y) / cos2) / (norm * cos2 * cos2), density);
        return select(h.z > Real(0.0f), density, Real(0.0f));
    }

    /// Smith's masking of direction w by facets of normal h, [0, 1].
    /// Source: Walter et al. 2007, equations 27 (Beckmann, rational fit) and 34 (GGX)
    [[nodiscard]] Real g1(Vec3<Real> w, Vec3<Real> h) const noexcept {
        const Real sx = alpha_u * w.x, sy = alpha_v * w.y;
        const Real slope2 = sx * sx + sy * sy;
        const Real z = abs(w.z);
        Real g{};
        if (any(ggx)) g = Real(2.0f) * z / (z + sqrt(z * z + slope2));
        if (const auto beckmann = !ggx; any(beckmann)) {
            const auto steep = slope2 * Real(2.56f) <= z * z;
            const Real a = z / sqrt(select(steep, Real(1.0f), slope2));
            const Real fit = (Real(3.535f) * a + Real(2.181f) * a * a) / (Real(1.0f) + Real(2.276f) * a + Real(2.577f) * a * a);
            g = select(beckmann, select(steep, Real(1.0f), fit), g);
        }
        return select(dot(w, h) * w.z > Real(0.0f), g, Real(0.0f));
    }

    /// Samples a normal: visible ones for GGX, all for Beckmann.
    /// @param wo  wo.z > 0
    /// @return    unit, z > 0; density pdf(wo, h)
    /// Source: GGX: Dupuy and Benyoub 2023, "Sampling visible GGX normals with spherical caps"
    [[nodiscard]] Vec3<Real> sample(Vec3<Real> wo, Vec2<Real> u) const noexcept {
        const SinCosOf<Real> sc = sincos_turns(u.x);
        Vec3<Real> h{};
        if (any(ggx)) {
            const Vec3<Real> w = normalize(Vec3<Real>{wo.x * alpha_u, wo.y * alpha_v, wo.z});
            const Real z = (Real(1.0f) - u.y) * (Real(1.0f) + w.z) - w.z;
            const Real s2 = Real(1.0f) - z * z;
            const Real s = sqrt(select(s2 > Real(0.0f), s2, Real(0.0f)));
            const Vec3<Real> c{s * sc.cos + w.x, s * sc.sin + w.y, z + w.z};
            h = Vec3<Real>{c.x * alpha_u, c.y * alpha_v, select(c.z > Real(1e-12f), c.z, Real(1e-12f))};
        }
        if (const auto beckmann = !ggx; any(beckmann)) {
            const Real r = sqrt(-log_poly(Real(1.0f) - u.y));
            assign<Real>(beckmann, h, Vec3<Real>{alpha_u * r * sc.cos, alpha_v * r * sc.sin, Real(1.0f)});
        }
        return normalize(h);
    }
    /// Density of sample(), per steradian of h.
    [[nodiscard]] Real pdf(Vec3<Real> wo, Vec3<Real> h) const noexcept {
        const Real density = d(h), c = dot(wo, h);
        const Real visible = select(c > Real(0.0f), g1(wo, h) * c * density / wo.z, Real(0.0f));
        return select(ggx, visible, density * h.z);
    }
};

#ifdef KOKSMA_ORDINARY
using Microfacet = MicrofacetOf<float>;
#endif

KOKSMA_MATHS_END
#endif
