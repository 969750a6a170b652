#include "ladder_scenes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace koksma::ladder {

glm::dmat4 translated(glm::dvec3 by) { return glm::translate(glm::dmat4(1.0), by); }
glm::dmat4 scaled(double by) { return glm::scale(glm::dmat4(1.0), glm::dvec3(by)); }
glm::dmat4 facing_up() { return glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1, 0, 0)); }
glm::dmat4 facing_down() { return glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(1, 0, 0)); }

glm::dmat4 look_at(glm::dvec3 origin, glm::dvec3 target) {
    const glm::dvec3 z = glm::normalize(target - origin);
    const glm::dvec3 up = std::abs(z.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z)), y = glm::cross(z, x);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

SceneDescription empty_scene(int pixels) {
    SceneDescription scene;
    scene.materials.emplace_back();
    scene.materials[0].front = Diffuse{};
    scene.film.width = scene.film.height = pixels;
    scene.camera.near_clip = 1e-6;
    scene.camera.far_clip = 1e9;
    return scene;
}

std::uint32_t add_material(SceneDescription& scene, OneSidedMaterial material) {
    scene.materials.emplace_back();
    scene.materials.back().front = std::move(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Shape& add_shape(SceneDescription& scene, Geometry geometry, const glm::dmat4& to_world, std::uint32_t material) {
    Shape shape;
    shape.geometry = std::move(geometry);
    shape.to_world = to_world;
    shape.material = material;
    scene.shapes.push_back(std::move(shape));
    return scene.shapes.back();
}

Shape& add_light(SceneDescription& scene, Geometry geometry, const glm::dmat4& to_world, double radiance) {
    const std::uint32_t black = add_material(scene, Diffuse{Rgb(0.0f)});
    Shape& shape = add_shape(scene, std::move(geometry), to_world, black);
    shape.emission = AreaEmission{Rgb(static_cast<float>(radiance)), {}};
    return shape;
}

SceneDescription furnace(const glm::dmat4& to_world, double half, float albedo, float radiance) {
    SceneDescription scene = empty_scene(4);
    const std::uint32_t wall = add_material(scene, Diffuse{Rgb(albedo)});
    Shape& cube = add_shape(scene, CubeShape{}, to_world * scaled(half), wall);
    cube.flip_normals = true;
    cube.emission = AreaEmission{Rgb(radiance), {}};
    scene.camera.to_world = to_world * translated(glm::dvec3(0.1, -0.2, 0.05) * half);
    scene.camera.fov_x_degrees = 90;
    scene.camera.near_clip = 1e-3 * half;
    scene.camera.far_clip = 1e3 * half;
    return scene;
}

SceneDescription floor_seen_from(glm::dvec3 direction, OneSidedMaterial material) {
    SceneDescription scene = empty_scene(1);
    const std::uint32_t floor = add_material(scene, std::move(material));
    add_shape(scene, RectangleShape{}, scaled(1e3) * facing_up(), floor);
    scene.camera.to_world = look_at(glm::normalize(direction), {0, 0, 0});
    scene.camera.fov_x_degrees = 1e-3;
    scene.integrator.max_depth = 2;
    return scene;
}

}  // namespace koksma::ladder
