#pragma once
// Descriptions of scenes with many lights of all kinds.

#include "random_lights.h"

#include <scenes/render_scene.h>

namespace koksma::testing {

[[nodiscard]] inline Matrix random_turn(Uniform& u) {
    const Vec3f axis = random_unit(u);
    return rotated({axis.x, axis.y, axis.z}, 360.0 * u());
}

/// A mesh of loose triangles in the unit cube; with normals, they lean from the triangle's own by up to `lean`.
[[nodiscard]] inline MeshShape loose_triangles(Uniform& u, std::uint32_t n, float edge, float lean = 0.0f) {
    std::vector<glm::vec3> corners, normals;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Vec3f c = random_in_cube(u), a = random_unit(u) * edge, b = random_unit(u) * edge;
        const Vec3f ng = normalize(cross(a, b) + Vec3f(1e-6f * edge * edge));
        for (const Vec3f& v : {c, c + a, c + b}) {
            corners.push_back(v);
            normals.push_back(normalize(ng + random_unit(u) * lean));
        }
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh(std::move(corners), std::move(triangles), lean > 0.0f ? std::move(normals) : std::vector<glm::vec3>{});
}

/// Adds n lights in the cube of half side 1 around the origin, of all kinds in turn, small, of different strength.
inline void add_lights(SceneDescription& d, Uniform& u, int n, double size = 0.03) {
    for (int i = 0; i < n; ++i) {
        const Vec3f c = random_in_cube(u);
        const Matrix at = translated({c.x, c.y, c.z}) * random_turn(u) * scaled(size * (0.2 + u()));
        const Rgb radiance(20.0f * u() * u(), 20.0f * u() * u(), 20.0f * u() * u());
        switch (i % 6) {
            case 0: add_light(d, RectangleShape{}, at * scaled({1.0, 0.4, 1.0}), radiance); break;
            case 1: add_light(d, DiskShape{}, at * scaled({1.0, 0.5, 1.0}), radiance).flip_normals = i % 4 == 1; break;
            case 2: add_light(d, SphereShape{}, at, radiance).flip_normals = i % 7 == 0; break;
            case 3: add_light(d, loose_triangles(u, 4, 1.0f, i % 4 == 1 ? 0.8f : 0.0f), at, radiance).flip_normals = i % 5 == 0; break;
            case 4: add_light(d, CubeShape{}, at * scaled(0.6), radiance); break;
            default: d.point_lights.push_back({{c.x, c.y, c.z}, Rgb(0.01f * radiance.x, 0.01f * radiance.y, 0.01f * radiance.z), {}}); break;
        }
    }
}

/// The same scene with its lights chosen by power.
[[nodiscard]] inline Ready by_power(const SceneDescription& d) {
    Ready ready(d);
    ready.scene.light_tree = {};
    return ready;
}

}  // namespace koksma::testing
