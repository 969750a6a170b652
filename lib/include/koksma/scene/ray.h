#pragma once
// Rays, and what they meet.

#include <koksma/math/vec3.h>

#include <cstdint>
#include <limits>

namespace koksma {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The points o + t d with t in [t_near, t_far]; d need not be unit.
struct Ray {
    Vec3f o, d;
    float t_near = 0.0f, t_far = kInfinity;
    float time = 0.0f;  ///< within the shutter's interval, [0, 1)
};

/// What a ray met: ids only. Everything else is recomputed from the vertices, since Embree's t, u, v depend on the CPU's
/// instruction set and its ids do not.
struct Hit {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    std::uint32_t geometry = kNone, primitive = kNone;
    std::uint32_t instance = kNone;  ///< index into Scene::instances of what the geometry is seen through
    [[nodiscard]] constexpr bool valid() const noexcept { return geometry != kNone; }
};

}  // namespace koksma
