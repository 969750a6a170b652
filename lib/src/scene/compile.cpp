#include <koksma/sampling/error.h>

#include "compile.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace koksma {

namespace {

CompiledCamera compile_camera(const Camera& c, const FilmSettings& film) {
    CompiledCamera out;
    const glm::dvec3 axes[3] = {glm::dvec3(c.to_world[0]), glm::dvec3(c.to_world[1]), glm::dvec3(c.to_world[2])};
    Vec3f* unit[3] = {&out.right, &out.up, &out.forward};
    for (int i = 0; i < 3; ++i) {
        const double len = glm::length(axes[i]);
        if (!(len > 0.0) || !std::isfinite(len)) throw Error(c.where.text() + ": the camera's to_world is singular");
        *unit[i] = Vec3f(glm::vec3(axes[i] / len));
    }
    out.half_width = std::tan(c.fov_x_degrees * (std::acos(-1.0) / 360.0));
    out.half_height = out.half_width * film.height / film.width;
    out.pixel_width = 1.0 / film.width;
    out.pixel_height = 1.0 / film.height;
    out.offset_x = c.principal_point_offset.x;
    out.offset_y = c.principal_point_offset.y;
    out.near_clip = static_cast<float>(c.near_clip);
    out.far_clip = static_cast<float>(c.far_clip);
    out.aperture_radius = static_cast<float>(c.aperture_radius);
    out.focus_distance = static_cast<float>(c.focus_distance);
    return out;
}

void build_accelerator(Scene& scene) {
    scene.positions.emplace_back(0.0f);  // Embree reads four floats at the last vertex
    for (std::size_t i = 0; i < scene.geometries.size(); ++i) {
        const GeometryRecord& g = scene.geometries[i];
        if (g.kind == GeometryKind::sphere) {
            scene.accelerator.add_sphere(scene.spheres[g.first]);
        } else if (g.kind == GeometryKind::disk) {
            scene.accelerator.add_disk(scene.disks[g.first]);
        } else {
            std::size_t end = scene.triangles.size();
            for (std::size_t j = i + 1; j < scene.geometries.size(); ++j)
                if (scene.geometries[j].kind == GeometryKind::mesh) {
                    end = scene.geometries[j].first;
                    break;
                }
            scene.accelerator.add_mesh(std::span(scene.positions).first(scene.positions.size() - 1),
                                       std::span(scene.triangles).subspan(g.first, end - g.first));
        }
    }
    scene.accelerator.commit();
}

}  // namespace

namespace detail {

TextureRef texture_ref(Scene& scene, const Texture& texture) {
    if (const auto* constant = std::get_if<Rgb>(&texture)) return {*constant, -1};
    scene.textures.push_back(texture);
    scene.effects |= {Effect::texture};
    return {Vec3f{0.0f}, static_cast<std::int32_t>(scene.textures.size() - 1)};
}

}  // namespace detail

Scene compile(const SceneDescription& description) {
    Scene scene;
    scene.description = description;
    scene.film = description.film;
    if (scene.film.crop_width == 0) {
        scene.film.crop_width = scene.film.width;
        scene.film.crop_height = scene.film.height;
    }
    scene.camera = compile_camera(description.camera, scene.film);
    if (description.camera.aperture_radius > 0.0) scene.effects |= {Effect::lens};
    const glm::dvec3 origin(description.camera.to_world[3]);
    detail::compile_materials(scene);
    detail::compile_shapes(scene, origin);
    build_accelerator(scene);
    detail::compile_lights(scene, origin);
    return scene;
}

}  // namespace koksma
