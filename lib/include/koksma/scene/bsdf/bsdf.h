#pragma once
// A BSDF at a point, with all textures looked up. Directions are local (shading normal +z); wo toward the camera, wi toward
// the light, both unit and outward.

#include <koksma/plan/effect.h>
#include <koksma/sampling/warps.h>
#include <koksma/scene/bsdf/fresnel.h>
#include <koksma/scene/bsdf/microfacet.h>

namespace koksma {

enum class BsdfKind : std::uint8_t { none, diffuse, dielectric, conductor, rough_conductor };

struct Bsdf {
    BsdfKind kind = BsdfKind::none;
    bool perfect = false;     ///< conductors: reflects everything
    Vec3f reflectance{0.0f};  ///< diffuse albedo, or scale of the specular reflection
    Vec3f transmittance{1.0f};
    Vec3f eta{1.0f}, k{0.0f};  ///< conductor's index; dielectric: eta.x = inside / outside
    Microfacet facets{};
};

/// What sampling gives. `weight` is f |cos| / pdf; a zero pdf means that there is no sample (weight is then zero).
struct BsdfSample {
    Vec3f wi{0.0f, 0.0f, 1.0f};
    Vec3f weight{0.0f};
    float pdf_w = 0.0f;   ///< per steradian; of a delta direction: the probability of the lobe
    float eta = 1.0f;     ///< index that the path enters over the one it leaves
    bool delta = false;
};

/// f(wo, wi) |cos(wi)| and the density with which sample_bsdf would draw wi; both zero for delta BSDFs.
struct BsdfValue {
    Vec3f f_cos{0.0f};
    float pdf_w = 0.0f;
};

/// True where light sampling can contribute.
[[nodiscard]] constexpr bool has_smooth_lobe(const Bsdf& b) noexcept { return b.kind == BsdfKind::diffuse || b.kind == BsdfKind::rough_conductor; }

[[nodiscard]] inline Vec3f conductor_reflectance(const Bsdf& b, float cos_i) noexcept {
    if (b.perfect) return b.reflectance;
    return b.reflectance * Vec3f{fresnel_conductor(cos_i, b.eta.x, b.k.x), fresnel_conductor(cos_i, b.eta.y, b.k.y),
                                 fresnel_conductor(cos_i, b.eta.z, b.k.z)};
}

template <EffectSet kEffects>
[[nodiscard]] BsdfValue eval_bsdf(const Bsdf& b, Vec3f wo, Vec3f wi) noexcept {
    if (!(wo.z > 0.0f && wi.z > 0.0f)) return {};
    if constexpr (kEffects.has(Effect::diffuse))
        if (b.kind == BsdfKind::diffuse) return {b.reflectance * (kInvPi * wi.z), kInvPi * wi.z};
    if constexpr (kEffects.has(Effect::glossy))
        if (b.kind == BsdfKind::rough_conductor) {
            const Vec3f h = normalize(wo + wi);
            const float d = b.facets.d(h);
            if (!(d > 0.0f)) return {};
            const float f = d * b.facets.g1(wo, h) * b.facets.g1(wi, h) / (4.0f * wo.z);
            return {conductor_reflectance(b, dot(wo, h)) * f, b.facets.pdf(wo, h) / (4.0f * dot(wo, h))};
        }
    return {};
}

/// @param u_lobe  chooses reflection or transmission (dielectrics only)
/// @param u       direction (BSDFs with a smooth lobe only)
template <EffectSet kEffects>
[[nodiscard]] BsdfSample sample_bsdf(const Bsdf& b, Vec3f wo, float u_lobe, glm::vec2 u) noexcept {
    if constexpr (kEffects.has(Effect::diffuse))
        if (b.kind == BsdfKind::diffuse) {
            if (!(wo.z > 0.0f)) return {};
            const Vec3f wi = square_to_cosine_hemisphere(u);
            if (!(wi.z > 0.0f)) return {};
            return {wi, b.reflectance, kInvPi * wi.z, 1.0f, false};
        }
    if constexpr (kEffects.has(Effect::specular))
        if (b.kind == BsdfKind::conductor) {
            if (!(wo.z > 0.0f)) return {};
            return {{-wo.x, -wo.y, wo.z}, conductor_reflectance(b, wo.z), 1.0f, 1.0f, true};
        }
    if constexpr (kEffects.has(Effect::dielectric))
        if (b.kind == BsdfKind::dielectric) {
            if (wo.z == 0.0f) return {};
            const DielectricFresnel f = fresnel_dielectric(wo.z, b.eta.x);
            if (u_lobe < f.reflectance) return {{-wo.x, -wo.y, wo.z}, b.reflectance, f.reflectance, 1.0f, true};
            // Radiance is compressed by the square of the index where a path enters: source Veach 1997, section 5.2.
            const Vec3f wi = normalize(Vec3f{-f.eta_ti * wo.x, -f.eta_ti * wo.y, f.cos_t});
            return {wi, b.transmittance * (f.eta_ti * f.eta_ti), 1.0f - f.reflectance, 1.0f / f.eta_ti, true};
        }
    if constexpr (kEffects.has(Effect::glossy))
        if (b.kind == BsdfKind::rough_conductor) {
            if (!(wo.z > 0.0f)) return {};
            const Vec3f h = b.facets.sample(wo, u);
            const float c = dot(wo, h);
            const Vec3f wi = h * (2.0f * c) - wo;
            if (!(c > 0.0f && wi.z > 0.0f)) return {};
            const float pdf = b.facets.pdf(wo, h) / (4.0f * c);
            if (!(pdf > 0.0f)) return {};
            // GGX: F G1(wi), the rest of the density cancels; Beckmann: F G |wo.h| / (cos_o cos_h).
            const float w = b.facets.ggx ? b.facets.g1(wi, h) : b.facets.g1(wo, h) * b.facets.g1(wi, h) * c / (wo.z * h.z);
            return {wi, conductor_reflectance(b, c) * w, pdf, 1.0f, false};
        }
    return {};
}

}  // namespace koksma
