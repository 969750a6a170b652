// Reflectance of an interface for unpolarised light.

#include <koksma/math/vec3.h>

#if defined(KOKSMA_SCENE_BSDF_FRESNEL_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_BSDF_FRESNEL_H
#undef KOKSMA_SCENE_BSDF_FRESNEL_H
#else
#define KOKSMA_SCENE_BSDF_FRESNEL_H
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
struct DielectricFresnelOf {
    Real reflectance;  ///< [0, 1]; 1 beyond the critical angle
    Real cos_t;        ///< cosine of the refracted direction, with the sign opposite to cos_i; 0 beyond the critical angle
    Real eta_ti;       ///< index of the incident over the transmitted side
};

/// @param cos_i  cosine between the normal and the direction; negative: from inside
/// @param eta    index below the surface over the index above it, > 0
/// Source: Born and Wolf, Principles of Optics, section 1.5.2
template <class Real>
[[nodiscard]] DielectricFresnelOf<Real> fresnel_dielectric(Real cos_i, Real eta) noexcept {
    const auto outside = cos_i >= Real(0.0f);
    const Real inverse = Real(1.0f) / eta;
    const Real eta_it = select(outside, eta, inverse), eta_ti = select(outside, inverse, eta);
    const Real cos2_t = Real(1.0f) - eta_ti * eta_ti * (Real(1.0f) - cos_i * cos_i);
    const auto transmits = cos2_t > Real(0.0f);
    const Real ci = abs(cos_i), ct = sqrt(select(transmits, cos2_t, Real(0.0f)));
    const Real s = (ci - eta_it * ct) / (ci + eta_it * ct);
    const Real p = (eta_it * ci - ct) / (eta_it * ci + ct);
    const Real r = select(eta == Real(1.0f), Real(0.0f), Real(0.5f) * (s * s + p * p));
    return {select(transmits, r, Real(1.0f)), select(outside, -ct, ct), eta_ti};
}

/// Per channel. @param cos_i  [0, 1]; @param eta, k  real and imaginary index relative to the outside
/// Source: Born and Wolf, Principles of Optics, section 14.2, in the form of S. Lagarde 2013, "Memo on Fresnel equations"
template <class Real>
[[nodiscard]] Real fresnel_conductor(Real cos_i, Real eta, Real k) noexcept {
    const Real c2 = cos_i * cos_i, s2 = Real(1.0f) - c2;
    const Real t0 = eta * eta - k * k - s2;
    const Real a2b2 = sqrt(t0 * t0 + Real(4.0f) * k * k * eta * eta);
    const Real t1 = a2b2 + c2;
    const Real half = Real(0.5f) * (a2b2 + t0);
    const Real a = sqrt(select(half > Real(0.0f), half, Real(0.0f)));
    const Real t2 = Real(2.0f) * a * cos_i;
    const Real rs = (t1 - t2) / (t1 + t2);
    const Real t3 = a2b2 * c2 + s2 * s2;
    const Real t4 = t2 * s2;
    // Both zero: normal incidence on eta = k = 0.
    const auto regular = t3 + t4 > Real(0.0f);
    const Real rp = select(regular, rs * (t3 - t4) / select(regular, t3 + t4, Real(1.0f)), rs);
    const Real r = Real(0.5f) * (rs + rp);
    return select(r > Real(0.0f), r, Real(0.0f));  // by an index of 1 rounding makes it -6e-8
}

KOKSMA_MATHS_END
#endif
