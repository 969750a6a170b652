#pragma once
// A diffuse base under a rough dielectric coat. What the coat lets through depends on the angle alone and is tabulated.

#include <koksma/scene/bsdf/plastic.h>
#include <koksma/scene/bsdf/rough_dielectric.h>

#include <array>

namespace koksma {

/// Share of light that facets let into the coat, by the cosine outside: 64 nodes in [0, 1], linear between them.
struct RoughTransmittance {
    std::array<float, 64> node{};
    [[nodiscard]] float operator()(float cosine) const noexcept {
        const float x = cosine * static_cast<float>(node.size() - 1);
        auto i = static_cast<std::size_t>(x);
        if (i > node.size() - 2) i = node.size() - 2;
        const float t = x - static_cast<float>(i);
        return node[i] * (1.0f - t) + node[i + 1] * t;
    }
};

struct RoughPlasticBsdf {
    PlasticBase base;
    Microfacet facets;
    RoughTransmittance through;
};

/// Shares of the light from a direction that facets reflect and let through once; what they mask is in neither.
struct RoughShares {
    float reflected = 0.0f, transmitted = 0.0f;
};
/// By quadrature over the normals that are seen.
/// @param cosine  of the direction, (0, 1]
/// @param eta     below / above the surface
[[nodiscard]] RoughShares rough_shares(const Microfacet& facets, float cosine, float eta);

/// Fills `through` and the base's inner reflectance from eta and facets.
void tabulate(RoughPlasticBsdf& b);

/// Source: Mitsuba 3, roughplastic
[[nodiscard]] inline BsdfValue eval_bsdf(const RoughPlasticBsdf& b, Vec3f wo, Vec3f wi) noexcept {
    if (!(wo.z > 0.0f && wi.z > 0.0f)) return {};
    const float t_o = b.through(wo.z), t_i = b.through(wi.z), p = b.base.coat_probability(1.0f - t_o);
    const float cosine = kInvPi * wi.z;
    BsdfValue v{b.base.base_color() * (cosine * t_o * t_i), cosine * (1.0f - p)};
    const Vec3f h = normalize(wo + wi);
    const float c = dot(wo, h), d = b.facets.d(h);
    if (d > 0.0f && c > 0.0f) {
        const float f = fresnel_dielectric(c, b.base.eta).reflectance;
        v.f_cos += b.base.specular * (f * d * b.facets.g1(wo, h) * b.facets.g1(wi, h) / (4.0f * wo.z));
        v.pdf_w += p * b.facets.pdf(wo, h) / (4.0f * c);
    }
    return v;
}

[[nodiscard]] inline BsdfSample sample_bsdf(const RoughPlasticBsdf& b, Vec3f wo, float u_lobe, Vec2f u) noexcept {
    if (!(wo.z > 0.0f)) return {};
    Vec3f wi;
    if (u_lobe < b.base.coat_probability(1.0f - b.through(wo.z))) {
        const Vec3f h = b.facets.sample(wo, u);
        wi = h * (2.0f * dot(wo, h)) - wo;
    } else {
        wi = square_to_cosine_hemisphere(u);
    }
    const BsdfValue v = eval_bsdf(b, wo, wi);
    if (!(v.pdf_w > 0.0f)) return {};
    return {wi, v.f_cos * (1.0f / v.pdf_w), v.pdf_w, 1.0f, false};
}

}  // namespace koksma
