#pragma once
// From a point of the film (and of the lens) to a ray.

#include <koksma/sampling/warps.h>
#include <koksma/scene/scene.h>

namespace koksma {

/// @param u       position within the pixel, [0, 1)^2; the integer pixel never meets it in float, so no sample leaves its pixel
/// @param u_lens  position on the aperture, [0, 1)^2 (thin lens only)
/// @return        ray with unit direction, clipped at the camera's near and far planes
template <EffectSet kEffects>
[[nodiscard]] Ray camera_ray(const Scene& scene, Pixel pixel, Vec2f u, Vec2f u_lens) noexcept {
    const CompiledCamera& c = scene.camera;
    const double fx = (pixel.x + static_cast<double>(u.x)) / scene.film.width + c.offset_x;
    const double fy = (pixel.y + static_cast<double>(u.y)) / scene.film.height + c.offset_y;
    // At distance 1 along the axis; +x of the camera points to the left of the image.
    const auto x = static_cast<float>((1.0 - 2.0 * fx) * c.half_width);
    const auto y = static_cast<float>((1.0 - 2.0 * fy) * c.half_height);
    Ray ray;
    Vec3f local{x, y, 1.0f};
    if constexpr (kEffects.has(Effect::lens)) {
        if (c.aperture_radius > 0.0f) {
            const Vec2f disk = square_to_disk(u_lens);
            const Vec3f on_lens{disk.x * c.aperture_radius, disk.y * c.aperture_radius, 0.0f};
            local = local * c.focus_distance - on_lens;
            ray.o = c.right * on_lens.x + c.up * on_lens.y;
        }
    }
    local = normalize(local);
    ray.d = c.right * local.x + c.up * local.y + c.forward * local.z;
    ray.t_near = c.near_clip / local.z;
    ray.t_far = c.far_clip / local.z;
    return ray;
}

}  // namespace koksma
