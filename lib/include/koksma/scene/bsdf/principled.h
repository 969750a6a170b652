#pragma once
// The principled material of Mitsuba 3: a diffuse lobe with retro-reflection and sheen, GGX reflection between metal and dielectric, GGX
// transmission, and a clear coat. Its numbers are those of a user's sliders; it is not reciprocal to the last term, nor are its energies bounded by 1
// for all of them (sheen adds, and Schlick's approximation of tints).

#include <koksma/scene/bsdf/rough_dielectric.h>

#include <cmath>

namespace koksma {

struct PrincipledBsdf {
    Vec3f base_color{0.5f};
    float roughness = 0.5f, anisotropic = 0.0f, metallic = 0.0f, spec_trans = 0.0f, spec_tint = 0.0f;
    float sheen = 0.0f, sheen_tint = 0.0f, flatness = 0.0f, clearcoat = 0.0f, clearcoat_gloss = 0.0f;
    float eta = 1.5f;                                                       ///< inside / outside
    float specular_rate = 1.0f, clearcoat_rate = 1.0f, diffuse_rate = 1.0f;  ///< of sampling
    bool has_spec_trans = false;                                            ///< the material says so, wherever its texture may be zero

    [[nodiscard]] Microfacet facets() const noexcept {
        const float a2 = roughness * roughness, aspect = std::sqrt(1.0f - 0.9f * anisotropic);
        const float u = a2 / aspect, v = a2 * aspect;
        return {u > 0.001f ? u : 0.001f, v > 0.001f ? v : 0.001f, true};
    }
    [[nodiscard]] float brdf() const noexcept { return (1.0f - metallic) * (1.0f - spec_trans); }
    [[nodiscard]] float bsdf() const noexcept { return (1.0f - metallic) * spec_trans; }
};

namespace principled {

[[nodiscard]] inline float mix(float a, float b, float t) noexcept { return a + (b - a) * t; }
[[nodiscard]] inline Vec3f mix(Vec3f a, Vec3f b, float t) noexcept { return a + (b - a) * t; }
[[nodiscard]] inline float square(float x) noexcept { return x * x; }

/// (1 - c)^5
[[nodiscard]] inline float schlick_weight(float c) noexcept {
    const float m = c < 0.0f ? 1.0f : c > 1.0f ? 0.0f : 1.0f - c;
    return square(square(m)) * m;
}
/// Schlick's weight on the side of the lower index. @param cos_i  of the facet; negative: from inside
[[nodiscard]] inline float schlick_weight(float cos_i, float eta) noexcept {
    const float eta_it = cos_i >= 0.0f ? eta : 1.0f / eta;
    if (eta_it > 1.0f) return schlick_weight(std::fabs(cos_i));
    const float cos2_t = 1.0f - (1.0f - cos_i * cos_i) / (eta_it * eta_it);
    return schlick_weight(cos2_t > 0.0f ? std::sqrt(cos2_t) : 0.0f);
}
/// Hue and saturation at luminance 1.
[[nodiscard]] inline Vec3f tint(Vec3f color) noexcept {
    const float l = luminance(color);
    return l > 0.0f ? color * (1.0f / l) : Vec3f(1.0f);
}

/// The clear coat's distribution of normals. Source: Burley 2012, "Physically based shading at Disney", appendix B (GTR, gamma = 1)
struct Gtr1 {
    float alpha2;
    explicit Gtr1(float gloss) noexcept : alpha2(square(mix(0.1f, 0.001f, gloss))) {}
    [[nodiscard]] float d(Vec3f h) const noexcept {
        if (!(h.z > 0.0f)) return 0.0f;
        // alpha^2 cos^2 + sin^2, whose textbook form 1 + (alpha^2 - 1) cos^2 cancels near the pole
        return (alpha2 - 1.0f) / (kPi * log_poly(alpha2) * (alpha2 * h.z * h.z + (h.x * h.x + h.y * h.y)));
    }
    [[nodiscard]] float pdf(Vec3f h) const noexcept { return d(h) * h.z; }
    [[nodiscard]] Vec3f sample(Vec2f u) const noexcept {
        const SinCos sc = sincos_turns(u.x);
        const float power = exp_poly(log_poly(alpha2) * (1.0f - u.y));  // alpha2^(1 - u)
        const float cos2 = (1.0f - power) / (1.0f - alpha2), sin2 = (power - alpha2) / (1.0f - alpha2);
        const float s = sin2 > 0.0f ? std::sqrt(sin2) : 0.0f;
        return {s * sc.cos, s * sc.sin, std::sqrt(cos2 > 0.0f ? cos2 : 0.0f)};
    }
};
/// Masking of the coat, of roughness 0.25 whatever its gloss.
[[nodiscard]] inline float coat_g1(Vec3f w, Vec3f h) noexcept { return Microfacet{0.25f, 0.25f, true}.g1(w, h); }

/// Probabilities of the lobes for a facet's Fresnel reflectance. They sum to 1.
struct Choice {
    float diffuse = 0.0f, clearcoat = 0.0f, transmission = 0.0f, reflection = 0.0f;
};
[[nodiscard]] inline Choice choice(const PrincipledBsdf& b, bool front, float f) noexcept {
    Choice c;
    if (front) {
        c.reflection = b.specular_rate * (1.0f - b.bsdf() * (1.0f - f));
        if (b.has_spec_trans) c.transmission = b.specular_rate * b.bsdf() * (1.0f - f);
        c.clearcoat = 0.25f * b.clearcoat * b.clearcoat_rate;
        c.diffuse = b.brdf() * b.diffuse_rate;
    } else {
        c.reflection = f;
        if (b.has_spec_trans) c.transmission = 1.0f - f;
    }
    const float sum = c.reflection + c.transmission + c.clearcoat + c.diffuse;
    const float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    return {c.diffuse * scale, c.clearcoat * scale, c.transmission * scale, c.reflection * scale};
}

/// Diffuse light, retro-reflection, flatness and sheen, per |cos(wi)|. @param c_d  cosine between half vector and wi
[[nodiscard]] inline Vec3f base(const PrincipledBsdf& b, Vec3f wo, Vec3f wi, float c_d) noexcept {
    const float f_i = schlick_weight(wi.z), f_o = schlick_weight(wo.z);
    const float retro = 2.0f * b.roughness * c_d * c_d;
    const float diffuse = (1.0f - 0.5f * f_o) * (1.0f - 0.5f * f_i) + retro * (f_i + f_o + f_i * f_o * (retro - 1.0f));
    const float half = 0.5f * retro, through = mix(1.0f, half, f_i) * mix(1.0f, half, f_o);
    const float flat = 1.25f * (through * (1.0f / (wi.z + wo.z) - 0.5f) + 0.5f);
    Vec3f f = b.base_color * (b.brdf() * kInvPi * mix(diffuse, flat, b.flatness));
    if (b.sheen > 0.0f) f += mix(Vec3f(1.0f), tint(b.base_color), b.sheen_tint) * (b.sheen * (1.0f - b.metallic) * schlick_weight(std::fabs(c_d)));
    return f;
}

/// Of the main reflection. @param cos_i  of the facet; @param f  dielectric
[[nodiscard]] inline Vec3f fresnel(const PrincipledBsdf& b, bool front, float cos_i, float f) noexcept {
    if (!front) return Vec3f(b.bsdf() * f);
    const float w = schlick_weight(cos_i, b.eta), eta_it = cos_i >= 0.0f ? b.eta : 1.0f / b.eta;
    const Vec3f metal = mix(b.base_color, Vec3f(1.0f), w);
    const Vec3f tinted = mix(tint(b.base_color) * square((eta_it - 1.0f) / (eta_it + 1.0f)), Vec3f(1.0f), w);
    return Vec3f((1.0f - b.metallic) * (1.0f - b.spec_tint) * f) + metal * b.metallic + tinted * ((1.0f - b.metallic) * b.spec_tint);
}

}  // namespace principled

/// Source: Burley 2012 and 2015, "Physically based shading at Disney" and "Extending the Disney BRDF"; terms and defaults of Mitsuba 3, principled
[[nodiscard]] inline BsdfValue eval_bsdf(const PrincipledBsdf& b, Vec3f wo, Vec3f wi) noexcept {
    using namespace principled;
    if (wo.z == 0.0f || wi.z == 0.0f) return {};
    const bool front = wo.z > 0.0f, reflects = wo.z * wi.z > 0.0f;
    if (!front && !(b.bsdf() > 0.0f)) return {};
    const float eta_path = front ? b.eta : 1.0f / b.eta;
    Vec3f h = wo + wi * (reflects ? 1.0f : eta_path);
    const float length2 = dot(h, h);
    if (!(length2 > 0.0f)) return {};
    h = h * ((h.z < 0.0f ? -1.0f : 1.0f) / std::sqrt(length2));
    const float o_h = dot(wo, h), i_h = dot(wi, h), c = std::fabs(o_h);
    const bool seen = o_h * wo.z > 0.0f && i_h * wi.z > 0.0f;  // facets turn no other side to wo and wi than the surface does
    const float f = fresnel_dielectric(o_h, b.eta).reflectance;
    const Choice choose = choice(b, front, f);
    const Microfacet facets = b.facets();
    const float d = facets.d(h), g = facets.g1(wo, h) * facets.g1(wi, h);
    const float facet_pdf = facets.pdf(front ? wo : -wo, h);
    BsdfValue v;
    if (!reflects) {
        if (!seen || !(b.bsdf() > 0.0f) || !b.has_spec_trans || !(f < 1.0f)) return {};
        const FacetRefraction r = facet_refraction(b.eta, front, c);
        if (!(r.reflectance < 1.0f) || r.bend == 0.0f) return {};
        const float jacobian = refraction_jacobian(r);
        const Vec3f color{std::sqrt(b.base_color.x), std::sqrt(b.base_color.y), std::sqrt(b.base_color.z)};
        v.f_cos = color * (b.bsdf() * (1.0f - f) * d * g * c * jacobian / (std::fabs(wo.z) * (r.eta * r.eta)));
        v.pdf_w = choose.transmission * facet_pdf * jacobian;
        return v;
    }
    if (seen) {
        v.f_cos += fresnel(b, front, o_h, f) * (d * g / (4.0f * std::fabs(wo.z)));
        v.pdf_w += choose.reflection * facet_pdf / (4.0f * c);
        if (front && b.clearcoat > 0.0f) {
            const Gtr1 coat(b.clearcoat_gloss);
            const float schlick = mix(0.04f, 1.0f, schlick_weight(o_h, b.eta));
            v.f_cos += Vec3f(b.clearcoat * 0.25f * schlick * coat.d(h) * coat_g1(wo, h) * coat_g1(wi, h) * wi.z);
            v.pdf_w += choose.clearcoat * coat.pdf(h) / (4.0f * c);
        }
    }
    if (front) {
        if (b.brdf() > 0.0f) v.f_cos += base(b, wo, wi, i_h) * wi.z;
        v.pdf_w += choose.diffuse * kInvPi * wi.z;
    }
    return v;
}

[[nodiscard]] inline BsdfSample sample_bsdf(const PrincipledBsdf& b, Vec3f wo, float u_lobe, Vec2f u) noexcept {
    using namespace principled;
    if (wo.z == 0.0f) return {};
    const bool front = wo.z > 0.0f;
    if (!front && !(b.bsdf() > 0.0f)) return {};
    const Vec3f above = front ? wo : -wo;
    const Microfacet facets = b.facets();
    const Vec3f facet = facets.sample(above, u);
    const float c = dot(above, facet);
    if (!(c > 0.0f)) return {};
    // Reflection and transmission share by the Fresnel reflectance of this facet. The other lobes' probabilities depend on no facet, because that sum is
    // constant; so evaluation, which knows the half vector alone, gives the density.
    const FacetRefraction r = facet_refraction(b.eta, front, c);
    const Choice choose = choice(b, front, r.reflectance);
    Vec3f wi;
    float eta = 1.0f;
    if (u_lobe < choose.diffuse) {
        wi = square_to_cosine_hemisphere(u);
    } else if (u_lobe < choose.diffuse + choose.clearcoat) {
        const Vec3f h = Gtr1(b.clearcoat_gloss).sample(u);
        wi = h * (2.0f * dot(wo, h)) - wo;
    } else if (u_lobe < choose.diffuse + choose.clearcoat + choose.transmission) {
        if (!(r.reflectance < 1.0f)) return {};
        wi = normalize((facet * r.bend - above) * (1.0f / r.eta));
        if (!front) wi = -wi;
        if (!(wi.z * wo.z < 0.0f)) return {};
        eta = r.eta;
    } else {
        wi = facet * (2.0f * c) - above;
        if (!front) wi = -wi;
        if (!(wi.z * wo.z > 0.0f)) return {};
    }
    if (eta == 1.0f && !(wi.z * wo.z > 0.0f)) return {};
    const BsdfValue v = eval_bsdf(b, wo, wi);
    if (!(v.pdf_w > 0.0f)) return {};
    return {wi, v.f_cos * (1.0f / v.pdf_w), v.pdf_w, eta, false};
}

}  // namespace koksma
