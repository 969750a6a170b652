#pragma once
// Rough glass: reflection and refraction by facets. Local directions; wo on either side.

#include <koksma/scene/bsdf/bsdf.h>

#include <cmath>

namespace koksma {

struct RoughDielectricBsdf {
    float eta = 1.5f;  ///< inside / outside
    Microfacet facets;
    Vec3f reflectance{1.0f}, transmittance{1.0f};
};

/// How a facet refracts. All in terms of c = |wo . h|, so that nothing cancels for an index near 1: the half vector wo + eta wi is
/// made of two directions that are nearly opposite there.
struct FacetRefraction {
    float eta = 1.0f;          ///< index that the path enters over the one it leaves
    float reflectance = 1.0f;  ///< Fresnel
    float bend = 0.0f;         ///< c - eta |wi . h|, which is wo . h + eta wi . h on the side of wo; 0 beyond the critical angle
    float cos_t = 0.0f;        ///< |wi . h|
};
[[nodiscard]] inline FacetRefraction facet_refraction(float eta_outside, bool outside, float c) noexcept {
    FacetRefraction r;
    r.eta = outside ? eta_outside : 1.0f / eta_outside;
    r.reflectance = fresnel_dielectric(outside ? c : -c, eta_outside).reflectance;
    const float excess = outside ? (r.eta - 1.0f) * (r.eta + 1.0f) : (1.0f - eta_outside) * (1.0f + eta_outside) * (r.eta * r.eta);
    const float s2 = excess + c * c;  // (eta |wi . h|)^2
    if (!(s2 > 0.0f)) {
        r.reflectance = 1.0f;
        return r;
    }
    const float s = std::sqrt(s2);
    r.bend = -excess / (c + s);
    r.cos_t = s / r.eta;
    return r;
}
/// d(h) / d(wi) of refraction. Source: Walter et al. 2007, equation 17
[[nodiscard]] inline float refraction_jacobian(const FacetRefraction& r) noexcept { return r.eta * r.eta * r.cos_t / (r.bend * r.bend); }

/// f |cos| and density. An index of 1 refracts nothing: it is a delta direction.
/// Source: Walter et al. 2007, "Microfacet models for refraction through rough surfaces", equations 20 and 21; times 1 / eta^2 for radiance
[[nodiscard]] inline BsdfValue eval_bsdf(const RoughDielectricBsdf& b, Vec3f wo, Vec3f wi) noexcept {
    if (wo.z == 0.0f || wi.z == 0.0f || b.eta == 1.0f) return {};
    const bool outside = wo.z > 0.0f, reflects = wo.z * wi.z > 0.0f;
    const float eta = reflects ? 1.0f : outside ? b.eta : 1.0f / b.eta;
    Vec3f h = wo + wi * eta;
    const float length2 = dot(h, h);
    if (!(length2 > 0.0f)) return {};
    h = h * ((h.z < 0.0f ? -1.0f : 1.0f) / std::sqrt(length2));
    const float o_h = dot(wo, h), i_h = dot(wi, h);
    // Facets are seen from the side from which the surface is: the others are masked, and would not be sampled.
    if (!(o_h * wo.z > 0.0f && i_h * wi.z > 0.0f)) return {};
    const float d = b.facets.d(h);
    if (!(d > 0.0f)) return {};
    const float c = std::fabs(o_h);
    const FacetRefraction r = facet_refraction(b.eta, outside, c);
    const float facet_pdf = b.facets.pdf(outside ? wo : -wo, h);
    const float g = b.facets.g1(wo, h) * b.facets.g1(wi, h);
    if (reflects) return {b.reflectance * (r.reflectance * d * g / (4.0f * std::fabs(wo.z))), facet_pdf * r.reflectance / (4.0f * c)};
    if (!(r.reflectance < 1.0f)) return {};
    const float t = 1.0f - r.reflectance, jacobian = refraction_jacobian(r);
    return {b.transmittance * (t * d * g * jacobian * c / (std::fabs(wo.z) * (r.eta * r.eta))), facet_pdf * t * jacobian};
}

[[nodiscard]] inline BsdfSample sample_bsdf(const RoughDielectricBsdf& b, Vec3f wo, float u_lobe, Vec2f u) noexcept {
    if (wo.z == 0.0f) return {};
    const bool outside = wo.z > 0.0f;
    const Vec3f above = outside ? wo : -wo;
    const Vec3f h = b.facets.sample(above, u);
    const float c = dot(above, h);
    if (!(c > 0.0f)) return {};
    const FacetRefraction r = facet_refraction(b.eta, outside, c);
    const float facet_pdf = b.facets.pdf(above, h);
    if (!(facet_pdf > 0.0f)) return {};
    const bool reflects = u_lobe < r.reflectance;
    // On the side of `above`, then turned back.
    Vec3f wi = reflects ? h * (2.0f * c) - above : normalize((h * r.bend - above) * (1.0f / r.eta));
    if (reflects ? !(wi.z > 0.0f) : !(wi.z < 0.0f)) return {};
    const float g = b.facets.g1(wi, h);
    const float w = b.facets.ggx ? g : b.facets.g1(above, h) * g * c / (above.z * h.z);
    BsdfSample s;
    s.wi = outside ? wi : -wi;
    s.eta = reflects ? 1.0f : r.eta;
    s.weight = reflects ? b.reflectance * w : b.transmittance * (w / (r.eta * r.eta));
    s.delta = b.eta == 1.0f;
    if (s.delta)
        s.pdf_w = 1.0f;
    else
        s.pdf_w = reflects ? facet_pdf * r.reflectance / (4.0f * c) : facet_pdf * (1.0f - r.reflectance) * refraction_jacobian(r);
    return s.pdf_w > 0.0f ? s : BsdfSample{};
}

}  // namespace koksma
