// A BSDF at a point, with all textures looked up. Directions are local (shading normal +z); wo toward the camera, wi toward
// the light, both unit and outward. Lanes of one pack may hold different kinds: each kind is computed where any lane has it.

#include <koksma/plan/effect.h>
#include <koksma/sampling/warps.h>
#include <koksma/scene/bsdf/fresnel.h>
#include <koksma/scene/bsdf/microfacet.h>

#include <concepts>

#if defined(KOKSMA_SCENE_BSDF_BSDF_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_BSDF_BSDF_H
#undef KOKSMA_SCENE_BSDF_BSDF_H
#else
#define KOKSMA_SCENE_BSDF_BSDF_H
#endif

#ifdef KOKSMA_ORDINARY
namespace koksma {

enum class BsdfKind : std::int32_t {
    none,
    diffuse,
    dielectric,
    conductor,
    rough_conductor,
    thin_dielectric,
    // Of several lobes or parts, computed by layered.h and not here. From here on in this order:
    layered,          ///< smooth lobes on the side of wo, and any delta lobes
    layered_through,  ///< smooth lobes on both sides
    layered_delta,    ///< delta lobes only
};

}  // namespace koksma
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
using BsdfKindOf = std::conditional_t<std::same_as<Real, float>, BsdfKind, IntOf<Real>>;

template <class Real>
struct BsdfOf {
    BsdfKindOf<Real> kind{};
    MaskOf<Real> perfect{};             ///< conductors: reflects everything
    Vec3<Real> reflectance{};           ///< diffuse albedo, or scale of the specular reflection
    Vec3<Real> transmittance{};
    Vec3<Real> eta{}, k{};              ///< conductor's index; dielectric: eta.x = inside / outside
    MicrofacetOf<Real> facets{};
};

/// What sampling gives. `weight` is f |cos| / pdf; a zero pdf means that there is no sample (weight is then zero).
template <class Real>
struct BsdfSampleOf {
    Vec3<Real> wi{};
    Vec3<Real> weight{};
    Real pdf_w{};           ///< per steradian; of a delta direction: the probability of the lobe
    Real eta{};             ///< index that the path enters over the one it leaves
    MaskOf<Real> delta{};
};
template <class Real>
constexpr void assign(MaskOf<Real> m, BsdfSampleOf<Real>& dst, const BsdfSampleOf<Real>& src) noexcept {
    assign<Real>(m, dst.wi, src.wi);
    assign<Real>(m, dst.weight, src.weight);
    dst.pdf_w = select(m, src.pdf_w, dst.pdf_w);
    dst.eta = select(m, src.eta, dst.eta);
    dst.delta = (m && src.delta) || (!m && dst.delta);
}

/// f(wo, wi) |cos(wi)| of the smooth lobes and the density with which sample_bsdf would draw wi from them; both zero for delta BSDFs.
template <class Real>
struct BsdfValueOf {
    Vec3<Real> f_cos{};
    Real pdf_w{};
};
template <class Real>
constexpr void assign(MaskOf<Real> m, BsdfValueOf<Real>& dst, const BsdfValueOf<Real>& src) noexcept {
    assign<Real>(m, dst.f_cos, src.f_cos);
    dst.pdf_w = select(m, src.pdf_w, dst.pdf_w);
}

template <class Real>
[[nodiscard]] constexpr MaskOf<Real> is(const BsdfOf<Real>& b, BsdfKind kind) noexcept {
    return b.kind == BsdfKindOf<Real>(static_cast<std::int32_t>(kind));
}

/// True where light sampling can contribute.
template <class Real>
[[nodiscard]] constexpr MaskOf<Real> has_smooth_lobe(const BsdfOf<Real>& b) noexcept {
    return is(b, BsdfKind::diffuse) || is(b, BsdfKind::rough_conductor) || is(b, BsdfKind::layered) || is(b, BsdfKind::layered_through);
}

template <class Real>
[[nodiscard]] constexpr MaskOf<Real> is_layered(const BsdfOf<Real>& b) noexcept {
    return is(b, BsdfKind::layered) || is(b, BsdfKind::layered_through) || is(b, BsdfKind::layered_delta);
}

/// True where sampling looks at its `u_lobe`.
template <class Real>
[[nodiscard]] constexpr MaskOf<Real> chooses_lobe(const BsdfOf<Real>& b) noexcept {
    return is(b, BsdfKind::dielectric) || is(b, BsdfKind::thin_dielectric) || is_layered(b);
}

/// The normal of the side from which light counts; zero where both count.
/// @param n     shading normal
/// @param wo_z  cosine between n and wo
template <class Real>
[[nodiscard]] constexpr Vec3<Real> lit_normal(const BsdfOf<Real>& b, Vec3<Real> n, Real wo_z) noexcept {
    const Real sign = select(is(b, BsdfKind::layered) && wo_z < Real(0.0f), Real(-1.0f), Real(1.0f));
    return n * select(is(b, BsdfKind::layered_through), Real(0.0f), sign);
}

template <class Real>
[[nodiscard]] Vec3<Real> conductor_reflectance(const BsdfOf<Real>& b, Real cos_i) noexcept {
    if (all(b.perfect)) return b.reflectance;
    const Vec3<Real> f = b.reflectance * Vec3<Real>{fresnel_conductor(cos_i, b.eta.x, b.k.x), fresnel_conductor(cos_i, b.eta.y, b.k.y),
                                                    fresnel_conductor(cos_i, b.eta.z, b.k.z)};
    return select<Real>(b.perfect, b.reflectance, f);
}

template <EffectSet kEffects, class Real>
[[nodiscard]] BsdfValueOf<Real> eval_bsdf(const BsdfOf<Real>& b, Vec3<Real> wo, Vec3<Real> wi) noexcept {
    BsdfValueOf<Real> out;
    const auto above = wo.z > Real(0.0f) && wi.z > Real(0.0f);
    if constexpr (kEffects.has(Effect::diffuse))
        if (const auto m = above && is(b, BsdfKind::diffuse); any(m))
            assign<Real>(m, out, BsdfValueOf<Real>{b.reflectance * (Real(kInvPi) * wi.z), Real(kInvPi) * wi.z});
    if constexpr (kEffects.has(Effect::glossy))
        if (const auto m = above && is(b, BsdfKind::rough_conductor); any(m)) {
            const Vec3<Real> h = normalize(wo + wi);
            const Real d = b.facets.d(h);
            const Real f = d * b.facets.g1(wo, h) * b.facets.g1(wi, h) / (Real(4.0f) * wo.z);
            assign<Real>(m && d > Real(0.0f), out,
                         BsdfValueOf<Real>{conductor_reflectance(b, dot(wo, h)) * f, b.facets.pdf(wo, h) / (Real(4.0f) * dot(wo, h))});
        }
    return out;
}

/// @param u_lobe  chooses reflection or transmission (where chooses_lobe)
/// @param u       direction (BSDFs with a smooth lobe only)
template <EffectSet kEffects, class Real>
[[nodiscard]] BsdfSampleOf<Real> sample_bsdf(const BsdfOf<Real>& b, Vec3<Real> wo, Real u_lobe, Vec2<Real> u) noexcept {
    using Sample = BsdfSampleOf<Real>;
    Sample out;
    const auto above = wo.z > Real(0.0f);
    const MaskOf<Real> never{};
    if constexpr (kEffects.has(Effect::diffuse))
        if (const auto m = above && is(b, BsdfKind::diffuse); any(m)) {
            const Vec3<Real> wi = square_to_cosine_hemisphere(u);
            assign<Real>(m && wi.z > Real(0.0f), out, Sample{wi, b.reflectance, Real(kInvPi) * wi.z, Real(1.0f), never});
        }
    if constexpr (kEffects.has(Effect::specular))
        if (const auto m = above && is(b, BsdfKind::conductor); any(m))
            assign<Real>(m, out, Sample{{-wo.x, -wo.y, wo.z}, conductor_reflectance(b, wo.z), Real(1.0f), Real(1.0f), m});
    if constexpr (kEffects.has(Effect::dielectric))
        if (const auto m = is(b, BsdfKind::dielectric) && wo.z != Real(0.0f); any(m)) {
            const DielectricFresnelOf<Real> f = fresnel_dielectric(wo.z, b.eta.x);
            const auto reflects = u_lobe < f.reflectance;
            // Radiance is compressed by the square of the index where a path enters: source Veach 1997, section 5.2.
            const Vec3<Real> refracted = normalize(Vec3<Real>{-f.eta_ti * wo.x, -f.eta_ti * wo.y, f.cos_t});
            assign<Real>(m && !reflects, out, Sample{refracted, b.transmittance * (f.eta_ti * f.eta_ti), Real(1.0f) - f.reflectance, Real(1.0f) / f.eta_ti, m});
            assign<Real>(m && reflects, out, Sample{{-wo.x, -wo.y, wo.z}, b.reflectance, f.reflectance, Real(1.0f), m});
        }
    if constexpr (kEffects.has(Effect::dielectric))
        if (const auto m = is(b, BsdfKind::thin_dielectric) && wo.z != Real(0.0f); any(m)) {
            // All that is reflected between the two interfaces: R + T R T + T R^3 T + ... = 2 R / (1 + R). Directions stay.
            const Real once = fresnel_dielectric(abs(wo.z), b.eta.x).reflectance;
            const Real r = select(once < Real(1.0f), Real(2.0f) * once / (Real(1.0f) + once), Real(1.0f));
            const auto reflects = u_lobe < r;
            assign<Real>(m && !reflects, out, Sample{-wo, b.transmittance, Real(1.0f) - r, Real(1.0f), m});
            assign<Real>(m && reflects, out, Sample{{-wo.x, -wo.y, wo.z}, b.reflectance, r, Real(1.0f), m});
        }
    if constexpr (kEffects.has(Effect::glossy))
        if (const auto m = above && is(b, BsdfKind::rough_conductor); any(m)) {
            const Vec3<Real> h = b.facets.sample(wo, u);
            const Real c = dot(wo, h);
            const Vec3<Real> wi = h * (Real(2.0f) * c) - wo;
            const Real pdf = b.facets.pdf(wo, h) / (Real(4.0f) * c);
            // GGX: F G1(wi), the rest of the density cancels; Beckmann: F G |wo.h| / (cos_o cos_h).
            const Real g = b.facets.g1(wi, h);
            const Real w = select(b.facets.ggx, g, b.facets.g1(wo, h) * g * c / (wo.z * h.z));
            assign<Real>(m && c > Real(0.0f) && wi.z > Real(0.0f) && pdf > Real(0.0f), out,
                         Sample{wi, conductor_reflectance(b, c) * w, pdf, Real(1.0f), never});
        }
    return out;
}

#ifdef KOKSMA_ORDINARY
using Bsdf = BsdfOf<float>;
using BsdfSample = BsdfSampleOf<float>;
using BsdfValue = BsdfValueOf<float>;
#endif

KOKSMA_MATHS_END
#endif
