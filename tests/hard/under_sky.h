#pragma once
// Planes and shapes under a constant sky of radiance 1: what is missing from 1 is what the material takes.

#include <scenes/render_scene.h>

namespace koksma::testing {

/// A wide floor seen under an angle from its normal.
inline SceneDescription plane_under_sky(OneSidedMaterial material, double degrees, bool two_sided = false) {
    SceneDescription d = empty_scene();
    const std::uint32_t m = add_material(d, std::move(material), two_sided);
    add_shape(d, RectangleShape{}, scaled(1e3) * kUp, m);
    d.environment = ConstantEnvironment{};
    const double a = glm::radians(degrees);
    look_narrowly(d, {std::sin(a), std::cos(a), 0}, {0, 0, 0});
    return d;
}

/// A shape of unit size seen from four metres; all of the film sees it or the sky.
inline SceneDescription shape_under_sky(Geometry geometry, OneSidedMaterial material) {
    SceneDescription d = empty_scene();
    const std::uint32_t m = add_material(d, std::move(material));
    add_shape(d, std::move(geometry), Matrix(1.0), m);
    d.environment = ConstantEnvironment{};
    d.camera.fov_x_degrees = 30;
    d.camera.to_world = look_at({0.2, 0.3, -4}, {0, 0, 0});
    return d;
}

}  // namespace koksma::testing
