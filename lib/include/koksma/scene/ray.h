#pragma once
// Rays, and where they may start without hitting the surface that they leave.

#include <koksma/math/vec3.h>

#include <bit>
#include <cstdint>
#include <limits>

namespace koksma {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The points o + t d with t in [t_near, t_far]; d need not be unit.
struct Ray {
    Vec3f o, d;
    float t_near = 0.0f, t_far = kInfinity;
};

/// What a ray met: ids only. Everything else is recomputed from the vertices, since Embree's t, u, v depend on the CPU's
/// instruction set and its ids do not.
struct Hit {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::uint32_t geometry = kNone, primitive = kNone;
    [[nodiscard]] constexpr bool valid() const noexcept { return geometry != kNone; }
};

/// gamma_n = n eps / (1 - n eps): bounds the relative error of n roundings.
/// Source: Higham 2002, Accuracy and Stability of Numerical Algorithms, lemma 3.1
[[nodiscard]] constexpr float error_gamma(int n) noexcept {
    constexpr float kEps = 0x1p-24f;
    return static_cast<float>(n) * kEps / (1.0f - static_cast<float>(n) * kEps);
}

/// The next float above x where `up`, else the next below. @param x  finite
[[nodiscard]] inline float next_float(float x, bool up) noexcept {
    if (x == 0.0f) return up ? std::numeric_limits<float>::denorm_min() : -std::numeric_limits<float>::denorm_min();
    const auto bits = std::bit_cast<std::int32_t>(x);
    return std::bit_cast<float>((x > 0.0f) == up ? bits + 1 : bits - 1);
}

/// Moves a point off its surface, to the side of w, just beyond the box that is known to hold the true point.
/// @param p_error  bound of the absolute error of each coordinate of p
/// @param ng       geometric normal, unit, either side
/// Source: Pharr, Jakob and Humphreys 2023, Physically Based Rendering, 4th ed., section 6.8.6
[[nodiscard]] inline Vec3f offset_origin(Vec3f p, Vec3f p_error, Vec3f ng, Vec3f w) noexcept {
    const float d = dot(abs(ng), p_error);
    const Vec3f offset = dot(w, ng) < 0.0f ? ng * -d : ng * d;
    Vec3f q = p + offset;
    // The addition rounds: step one float further out wherever there is an offset.
    if (offset.x != 0.0f) q.x = next_float(q.x, offset.x > 0.0f);
    if (offset.y != 0.0f) q.y = next_float(q.y, offset.y > 0.0f);
    if (offset.z != 0.0f) q.z = next_float(q.z, offset.z > 0.0f);
    return q;
}

}  // namespace koksma
