#pragma once
// How a point of a medium scatters. Directions leave the point: wo toward the camera, wi toward the light, so wi = -wo is straight on.

#include <koksma/sampling/warps.h>

#include <cmath>

namespace koksma {

/// Below this |g| the phase function is isotropic to the last bits, and its inverse would divide by g.
inline constexpr float kIsotropic = 1e-4f;

/// The phase function, which is also the density of sample_phase.
/// @param g    mean cosine of the deflection, in (-1, 1); above 0: forward
/// @param cos  between wo and wi
/// @return     per steradian
/// Source: Henyey and Greenstein 1941, "Diffuse radiation in the galaxy", eq. 2
[[nodiscard]] inline float eval_phase(float g, float cos) noexcept {
    if (std::fabs(g) < kIsotropic) return 0.25f * kInvPi;
    // 1 + g^2 + 2 g cos without its cancellation near the peak.
    const float far = 1.0f - std::fabs(g), off = g > 0.0f ? 1.0f + cos : 1.0f - cos;
    const float d = far * far + 2.0f * std::fabs(g) * (off > 0.0f ? off : 0.0f);
    return 0.25f * kInvPi * (1.0f - g * g) / (d * std::sqrt(d));
}

/// A direction wi with the density eval_phase.
/// @param u  [0, 1)^2
/// Source: the inverse of the cosine's distribution, Pharr, Jakob and Humphreys 2023, section 11.3.1
[[nodiscard]] inline Vec3f sample_phase(float g, Vec3f wo, Vec2f u) noexcept {
    if (std::fabs(g) < kIsotropic) return square_to_sphere(u);
    // About the peak: 1 - cos = (((1 - a^2) / q)^2 - (1 - a)^2) / 2a, where (1 + a) / q - 1 = 2a (1 - u) / q.
    const float a = std::fabs(g), far = 1.0f - a, rest = 1.0f - u.y;
    const float q = far + 2.0f * a * u.y;
    const float h = far * far * (rest / q) * ((1.0f + a) / q + 1.0f);
    const float one_minus_cos = h < 2.0f ? h : 2.0f;
    const float r = std::sqrt(one_minus_cos * (2.0f - one_minus_cos));
    const SinCos phi = sincos_turns(u.x);
    const Frame frame = Frame::from_normal(g > 0.0f ? -wo : wo);
    return frame.to_world({r * phi.cos, r * phi.sin, 1.0f - one_minus_cos});
}

}  // namespace koksma
