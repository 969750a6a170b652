#pragma once
// Reflectance of an interface for unpolarised light.

#include <koksma/math/vec3.h>

#include <cmath>

namespace koksma {

struct DielectricFresnel {
    float reflectance;  ///< [0, 1]; 1 beyond the critical angle
    float cos_t;        ///< cosine of the refracted direction, with the sign opposite to cos_i; 0 beyond the critical angle
    float eta_ti;       ///< index of the incident over the transmitted side
};

/// @param cos_i  cosine between the normal and the direction; negative: from inside
/// @param eta    index below the surface over the index above it, > 0
/// Source: Born and Wolf, Principles of Optics, section 1.5.2
[[nodiscard]] inline DielectricFresnel fresnel_dielectric(float cos_i, float eta) noexcept {
    const bool outside = cos_i >= 0.0f;
    const float eta_it = outside ? eta : 1.0f / eta, eta_ti = outside ? 1.0f / eta : eta;
    const float cos2_t = 1.0f - eta_ti * eta_ti * (1.0f - cos_i * cos_i);
    if (!(cos2_t > 0.0f)) return {1.0f, 0.0f, eta_ti};
    const float ci = std::fabs(cos_i), ct = std::sqrt(cos2_t);
    const float s = (ci - eta_it * ct) / (ci + eta_it * ct);
    const float p = (eta_it * ci - ct) / (eta_it * ci + ct);
    const float r = eta == 1.0f ? 0.0f : 0.5f * (s * s + p * p);
    return {r, outside ? -ct : ct, eta_ti};
}

/// Per channel. @param cos_i  [0, 1]; @param eta, k  real and imaginary index relative to the outside
/// Source: Born and Wolf, Principles of Optics, section 14.2, in the form of S. Lagarde 2013, "Memo on Fresnel equations"
[[nodiscard]] inline float fresnel_conductor(float cos_i, float eta, float k) noexcept {
    const float c2 = cos_i * cos_i, s2 = 1.0f - c2;
    const float t0 = eta * eta - k * k - s2;
    const float a2b2 = std::sqrt(t0 * t0 + 4.0f * k * k * eta * eta);
    const float t1 = a2b2 + c2;
    const float half = 0.5f * (a2b2 + t0);
    const float a = std::sqrt(half > 0.0f ? half : 0.0f);
    const float t2 = 2.0f * a * cos_i;
    const float rs = (t1 - t2) / (t1 + t2);
    const float t3 = a2b2 * c2 + s2 * s2;
    const float t4 = t2 * s2;
    const float rp = t3 + t4 > 0.0f ? rs * (t3 - t4) / (t3 + t4) : rs;  // both zero: normal incidence on eta = k = 0
    const float r = 0.5f * (rs + rp);
    return r > 0.0f ? r : 0.0f;  // by an index of 1 rounding makes it -6e-8
}

}  // namespace koksma
