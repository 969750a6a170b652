#pragma once
// Where textures are looked up.

#include <koksma/math/vec3.h>

#include <cstdint>

namespace koksma {

/// Where on its surface a point is, for textures.
struct SurfaceUv {
    float x = 0.0f, y = 0.0f;
    std::uint32_t triangle = 0;  ///< index in Scene::triangles; with its barycentrics, only for mesh attributes
    Vec2f barycentrics{};
    SurfaceUv() = default;
    SurfaceUv(float u, float v) : x(u), y(v) {}
    SurfaceUv(Vec2f uv) : x(uv.x), y(uv.y) {}  // NOLINT: a pair of numbers is a place
    SurfaceUv& operator=(Vec2f uv) noexcept {
        x = uv.x;
        y = uv.y;
        return *this;
    }
};

}  // namespace koksma
