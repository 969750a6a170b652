#pragma once
// A diffuse base under a smooth dielectric coat. Between the two light is reflected again and again, in closed form.

#include <koksma/scene/bsdf/bsdf.h>

namespace koksma {

struct PlasticBase {
    Vec3f diffuse{0.5f}, specular{1.0f};
    float eta = 1.49f;              ///< inside / outside
    float inner_reflectance = 0.6f; ///< of the coat from inside, for diffuse light
    float specular_share = 0.5f;    ///< mean specular over mean specular + diffuse: how often the coat is sampled, Fresnel aside
    bool nonlinear = false;         ///< colours change with the number of inner reflections

    /// What the base sends through the coat, per 1 / pi and the coat's transmittance of both directions.
    [[nodiscard]] Vec3f base_color() const noexcept {
        const Vec3f d = nonlinear ? diffuse * inner_reflectance : Vec3f(inner_reflectance);
        const float inverse = 1.0f / (eta * eta);
        return {diffuse.x / (1.0f - d.x) * inverse, diffuse.y / (1.0f - d.y) * inverse, diffuse.z / (1.0f - d.z) * inverse};
    }
    /// Probability of the coat. @param reflectance  of the coat for wo
    [[nodiscard]] float coat_probability(float reflectance) const noexcept {
        const float coat = reflectance * specular_share, base = (1.0f - reflectance) * (1.0f - specular_share);
        return coat + base > 0.0f ? coat / (coat + base) : 0.0f;
    }
};
struct PlasticBsdf {
    PlasticBase base;
};

/// Share of diffuse light that a smooth interface reflects. @param eta  transmitted over incident side
/// Source: fits by Egan and Hilgeman 1973 (eta < 1) and by d'Eon and Irving 2011 (eta >= 1), within 0.6 % for usual indices; those of Mitsuba 3
[[nodiscard]] inline float diffuse_fresnel_reflectance(float eta) noexcept {
    const float inverse = 1.0f / eta;
    if (eta < 1.0f) return 0.0636f * inverse + (eta * (eta * -1.4399f + 0.7099f) + 0.6681f);
    return 0.919317f + inverse * (-3.4793f + inverse * (6.75335f + inverse * (-7.80989f + inverse * (4.98554f + inverse * -1.36881f))));
}

/// The base alone: the coat reflects into one direction.
/// Source: Mitsuba 3, plastic; after Jensen et al. 2001, Weidlich and Wilkie 2007
[[nodiscard]] inline BsdfValue eval_bsdf(const PlasticBsdf& b, Vec3f wo, Vec3f wi) noexcept {
    if (!(wo.z > 0.0f && wi.z > 0.0f)) return {};
    const float f_o = fresnel_dielectric(wo.z, b.base.eta).reflectance, f_i = fresnel_dielectric(wi.z, b.base.eta).reflectance;
    const float cosine = kInvPi * wi.z;
    return {b.base.base_color() * (cosine * (1.0f - f_o) * (1.0f - f_i)), cosine * (1.0f - b.base.coat_probability(f_o))};
}

[[nodiscard]] inline BsdfSample sample_bsdf(const PlasticBsdf& b, Vec3f wo, float u_lobe, Vec2f u) noexcept {
    if (!(wo.z > 0.0f)) return {};
    const float f_o = fresnel_dielectric(wo.z, b.base.eta).reflectance, p = b.base.coat_probability(f_o);
    if (u_lobe < p) return {{-wo.x, -wo.y, wo.z}, b.base.specular * (f_o / p), p, 1.0f, true};
    const Vec3f wi = square_to_cosine_hemisphere(u);
    if (!(wi.z > 0.0f)) return {};
    const float f_i = fresnel_dielectric(wi.z, b.base.eta).reflectance;
    return {wi, b.base.base_color() * ((1.0f - f_o) * (1.0f - f_i) / (1.0f - p)), kInvPi * wi.z * (1.0f - p), 1.0f, false};
}

}  // namespace koksma
