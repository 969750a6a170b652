// From a point of the film (and of the lens) to a ray, in the camera's world: it sits at the origin.

#include <koksma/math/vec3.h>
#include <koksma/sampling/warps.h>
#include <koksma/scene/film_filter.h>

#if defined(KOKSMA_SCENE_CAMERA_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_CAMERA_H
#undef KOKSMA_SCENE_CAMERA_H
#else
#define KOKSMA_SCENE_CAMERA_H
#endif

#ifdef KOKSMA_ORDINARY
namespace koksma {

/// Camera in the re-centred world: it sits at the origin.
struct CompiledCamera {
    Vec3f right, up, forward;        ///< unit; images of the camera's x, y, z
    double half_width = 1.0, half_height = 1.0;  ///< of the film at distance 1
    double offset_x = 0.0, offset_y = 0.0;
    double pixel_width = 1.0, pixel_height = 1.0;  ///< as parts of the film
    float near_clip = 1e-2f, far_clip = 1e4f;
    float aperture_radius = 0.0f, focus_distance = 1.0f;
    bool orthographic = false;  ///< film points are where the rays start; clips are distances along them
    std::int32_t width = 1, height = 1;  ///< of the film, in pixels
    CompiledFilter filter;
};

/// The point of the plane at distance 1 along the axis (of an orthographic camera, of its own plane); +x of the camera points to the left of the image.
/// @param pixel_x, pixel_y  of the full film; they never meet u in float, so no sample leaves its pixel
/// @param u                 in [0, 1)^2: position within the pixel, or what a wider filter makes one of
[[nodiscard]] inline Vec2f film_point(const CompiledCamera& c, std::int32_t pixel_x, std::int32_t pixel_y, Vec2f u) noexcept {
    if (!c.filter.is_pixel()) u = {c.filter.position(pixel_x, c.width, u.x), c.filter.position(pixel_y, c.height, u.y)};
    const double fx = (pixel_x + static_cast<double>(u.x)) * c.pixel_width + c.offset_x;
    const double fy = (pixel_y + static_cast<double>(u.y)) * c.pixel_height + c.offset_y;
    return {static_cast<float>((1.0 - 2.0 * fx) * c.half_width), static_cast<float>((1.0 - 2.0 * fy) * c.half_height)};
}

}  // namespace koksma
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
struct CameraRayOf {
    Vec3<Real> o, d;  ///< d: unit
    Real t_near, t_far;
};

/// @param film    film_point()
/// @param u_lens  position on the aperture, [0, 1)^2; not looked at without a lens
template <class Real>
[[nodiscard]] CameraRayOf<Real> camera_ray(const CompiledCamera& c, Vec2<Real> film, Vec2<Real> u_lens) noexcept {
    Vec3<Real> o{}, local{film.x, film.y, Real(1.0f)};
    const auto right = Vec3<Real>::splat(c.right), up = Vec3<Real>::splat(c.up), forward = Vec3<Real>::splat(c.forward);
    if (c.orthographic) return {right * film.x + up * film.y, forward, Real(c.near_clip), Real(c.far_clip)};
    if (c.aperture_radius > 0.0f) {
        const Vec2<Real> disk = square_to_disk(u_lens);
        const Vec3<Real> on_lens{disk.x * Real(c.aperture_radius), disk.y * Real(c.aperture_radius), Real(0.0f)};
        local = local * Real(c.focus_distance) - on_lens;
        o = right * on_lens.x + up * on_lens.y;
    }
    local = normalize(local);
    return {o, right * local.x + up * local.y + forward * local.z, Real(c.near_clip) / local.z, Real(c.far_clip) / local.z};
}

KOKSMA_MATHS_END
#endif
