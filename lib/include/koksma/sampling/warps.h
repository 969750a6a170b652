#pragma once
// Maps from the unit square to the domains that a path tracer samples. Continuous, so neighbouring strata stay neighbours.

#include <koksma/math/vec3.h>
#include <koksma/simd/elementary.h>

#include <glm/vec2.hpp>

#include <cmath>

namespace koksma {

/// Uniform on the unit disk.
/// @param u  [0, 1)^2
/// Source: Shirley and Chiu 1997, "A low distortion map between disk and square", JGT 2(3)
[[nodiscard]] inline glm::vec2 square_to_disk(glm::vec2 u) noexcept {
    const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;
    if (a == 0.0f && b == 0.0f) return {0.0f, 0.0f};
    const bool wide = std::fabs(a) > std::fabs(b);
    const float r = wide ? a : b;
    const float turns = wide ? 0.125f * (b / a) : 0.25f - 0.125f * (a / b);
    const SinCos sc = sincos_turns(turns);
    return {r * sc.cos, r * sc.sin};
}

/// Cosine-weighted on the hemisphere around +z.
/// @return  unit vector, z >= 0; density z / pi per steradian; z is 0 for no u in [0, 1)^2 beyond rounding
[[nodiscard]] inline Vec3f square_to_cosine_hemisphere(glm::vec2 u) noexcept {
    const glm::vec2 d = square_to_disk(u);
    const float z2 = 1.0f - d.x * d.x - d.y * d.y;
    return {d.x, d.y, std::sqrt(z2 > 0.0f ? z2 : 0.0f)};
}

/// Uniform on the sphere; density 1 / (4 pi).
[[nodiscard]] inline Vec3f square_to_sphere(glm::vec2 u) noexcept {
    const float z = 1.0f - 2.0f * u.y;
    const float r = 2.0f * std::sqrt(u.y * (1.0f - u.y));  // sqrt(1 - z^2) without its cancellation
    const SinCos sc = sincos_turns(u.x);
    return {r * sc.cos, r * sc.sin, z};
}

/// Uniform on a triangle. @return  barycentrics of the second and third vertex
/// Source: Heitz 2019, "A low-distortion map between triangle and square"
[[nodiscard]] inline glm::vec2 square_to_triangle(glm::vec2 u) noexcept {
    float b1 = u.x, b2 = u.y;
    if (b2 > b1) {
        b1 *= 0.5f;
        b2 -= b1;
    } else {
        b2 *= 0.5f;
        b1 -= b2;
    }
    return {b1, b2};
}

/// 1 - cos(theta) from sin^2(theta), for theta in [0, pi/2], without cancellation.
[[nodiscard]] inline float one_minus_cos(float sin2) noexcept {
    return sin2 / (1.0f + std::sqrt(1.0f - sin2 > 0.0f ? 1.0f - sin2 : 0.0f));
}

/// Uniform in a cone around +z. @param one_minus_cos_max  1 - cos of the half angle, > 0
/// @return  unit vector; density 1 / (2 pi one_minus_cos_max)
[[nodiscard]] inline Vec3f square_to_cone(glm::vec2 u, float one_minus_cos_max) noexcept {
    const float h = u.y * one_minus_cos_max;         // 1 - cos(theta)
    const float r = std::sqrt(h * (2.0f - h));       // sin(theta), no cancellation for small cones
    const SinCos sc = sincos_turns(u.x);
    return {r * sc.cos, r * sc.sin, 1.0f - h};
}

}  // namespace koksma
