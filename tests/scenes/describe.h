#pragma once
// Scenes as values, in the few words that tests need.

#include <koksma/scene/description.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace koksma::testing {

using Matrix = glm::dmat4;

[[nodiscard]] inline Matrix translated(glm::dvec3 by) { return glm::translate(Matrix(1.0), by); }
[[nodiscard]] inline Matrix scaled(glm::dvec3 by) { return glm::scale(Matrix(1.0), by); }
[[nodiscard]] inline Matrix scaled(double by) { return scaled(glm::dvec3(by)); }
[[nodiscard]] inline Matrix rotated(glm::dvec3 axis, double degrees) { return glm::rotate(Matrix(1.0), glm::radians(degrees), axis); }

/// Mitsuba's: the camera looks along +z, +x is left in the image.
[[nodiscard]] inline Matrix look_at(glm::dvec3 origin, glm::dvec3 target, glm::dvec3 up = {0, 1, 0}) {
    const glm::dvec3 z = glm::normalize(target - origin);
    if (glm::length(glm::cross(up, z)) < 1e-6) up = {0, 0, 1};
    const glm::dvec3 x = glm::normalize(glm::cross(up, z)), y = glm::cross(z, x);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

/// Turns the rectangle (normal +z) into a floor (normal +y) or a ceiling (normal -y).
inline const Matrix kUp = rotated({1, 0, 0}, -90);
inline const Matrix kDown = rotated({1, 0, 0}, 90);

/// An empty scene with a small film and no limit to path length.
[[nodiscard]] inline SceneDescription empty_scene(std::int32_t width = 4, std::int32_t height = 4) {
    SceneDescription d;
    d.materials.emplace_back();
    d.materials[0].front = Diffuse{};
    d.film.width = width;
    d.film.height = height;
    d.camera.near_clip = 1e-6;
    d.camera.far_clip = 1e9;
    return d;
}

[[nodiscard]] inline std::uint32_t add_material(SceneDescription& d, OneSidedMaterial front, bool two_sided = false) {
    Material m;
    m.front = front;
    m.two_sided = two_sided;
    if (two_sided) m.back = std::move(front);
    d.materials.push_back(std::move(m));
    return static_cast<std::uint32_t>(d.materials.size() - 1);
}
[[nodiscard]] inline std::uint32_t add_diffuse(SceneDescription& d, float albedo, bool two_sided = false) {
    return add_material(d, Diffuse{Rgb(albedo)}, two_sided);
}

inline Shape& add_shape(SceneDescription& d, Geometry geometry, const Matrix& to_world, std::uint32_t material) {
    Shape s;
    s.geometry = std::move(geometry);
    s.to_world = to_world;
    s.material = material;
    d.shapes.push_back(std::move(s));
    return d.shapes.back();
}
/// A light that reflects nothing.
inline Shape& add_light(SceneDescription& d, Geometry geometry, const Matrix& to_world, Texture radiance) {
    const std::uint32_t black = add_diffuse(d, 0.0f);
    Shape& s = add_shape(d, std::move(geometry), to_world, black);
    s.emission = AreaEmission{std::move(radiance), {}};
    return s;
}

/// A closed surface that looks and shines inwards: radiance le / (1 - albedo) everywhere.
[[nodiscard]] inline SceneDescription furnace(Geometry geometry, const Matrix& to_world, float albedo, float le) {
    SceneDescription d = empty_scene();
    const std::uint32_t wall = add_diffuse(d, albedo);
    Shape& s = add_shape(d, std::move(geometry), to_world, wall);
    s.flip_normals = true;
    s.emission = AreaEmission{Rgb(le), {}};
    d.camera.fov_x_degrees = 90;
    return d;
}

/// A film of one direction: 1 x 1 pixels so narrow that the camera sees one point.
inline void look_narrowly(SceneDescription& d, glm::dvec3 origin, glm::dvec3 target, double fov = 1e-3) {
    d.film.width = d.film.height = 1;
    d.camera.fov_x_degrees = fov;
    d.camera.to_world = look_at(origin, target);
}

[[nodiscard]] inline MeshShape mesh(std::vector<glm::vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles,
                                    std::vector<glm::vec3> normals = {}) {
    auto data = std::make_shared<MeshData>();
    data->positions = std::move(positions);
    data->triangles = std::move(triangles);
    data->normals = std::move(normals);
    return {std::move(data)};
}

[[nodiscard]] inline std::shared_ptr<const Image> image(int width, int height, std::vector<Rgb> texels) {
    auto out = std::make_shared<Image>();
    out->width = width;
    out->height = height;
    out->texels = std::move(texels);
    return out;
}

/// One channel, cells in the order (z, y, x).
[[nodiscard]] inline std::shared_ptr<const VolumeGrid> grid(std::int32_t nx, std::int32_t ny, std::int32_t nz, std::vector<float> values) {
    auto out = std::make_shared<VolumeGrid>();
    out->size = {nx, ny, nz};
    out->channels = static_cast<std::int32_t>(values.size()) / (nx * ny * nz);
    out->values = std::move(values);
    return out;
}

}  // namespace koksma::testing
