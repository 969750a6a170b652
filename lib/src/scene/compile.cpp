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
    const double aspect = static_cast<double>(film.height) / film.width;
    out.half_width = std::tan(c.fov_x_degrees * (std::acos(-1.0) / 360.0));
    out.half_height = out.half_width * aspect;
    out.width = film.width;
    out.height = film.height;
    try {
        out.filter = compile_filter(film.filter);
    } catch (const Error& e) {
        throw Error(c.where.text() + ": " + e.what());
    }
    out.pixel_width = 1.0 / film.width;
    out.pixel_height = 1.0 / film.height;
    out.offset_x = c.principal_point_offset.x;
    out.offset_y = c.principal_point_offset.y;
    out.near_clip = static_cast<float>(c.near_clip);
    out.far_clip = static_cast<float>(c.far_clip);
    out.aperture_radius = static_cast<float>(c.aperture_radius);
    out.focus_distance = static_cast<float>(c.focus_distance);
    if (c.orthographic) {
        // The transform scales the plane and the way to the near clip, but not the depth between the clips: as in Mitsuba.
        out.orthographic = true;
        out.half_width = glm::length(axes[0]);
        out.half_height = glm::length(axes[1]) * aspect;
        out.offset_x = out.offset_y = 0.0;
        const double start = c.near_clip * glm::length(axes[2]);
        out.near_clip = static_cast<float>(start);
        out.far_clip = static_cast<float>(start + c.far_clip - c.near_clip);
        out.aperture_radius = 0.0f;
    }
    return out;
}

void build_accelerator(Scene& scene) {
    scene.positions.emplace_back(0.0f);  // Embree reads four floats at the last vertex
    std::size_t group = 0;
    for (std::size_t i = 0; i < scene.geometries.size(); ++i) {
        for (; group < scene.groups.size() && scene.groups[group].first_geometry == i; ++group) scene.accelerator.begin_group();
        const GeometryRecord& g = scene.geometries[i];
        if (g.kind == GeometryKind::sphere) {
            scene.accelerator.add_sphere(scene.spheres[g.first]);
        } else if (g.kind == GeometryKind::disk) {
            scene.accelerator.add_disk(scene.disks[g.first]);
        } else if (g.kind == GeometryKind::cylinder) {
            scene.accelerator.add_cylinder(scene.cylinders[g.first]);
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
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceRecord& instance = scene.instances[i];
        scene.accelerator.add_instance(scene.description.instances[i].group,
                                       std::span(scene.placements).subspan(instance.first_placement, instance.placement_count));
    }
    scene.accelerator.commit();
}

}  // namespace

namespace detail {

namespace {

/// Textures over the same attribute share its values. They are filled in where the shapes are compiled.
AttributeSlot attribute_slot(Scene& scene, const Texture& texture) {
    const auto* attribute = std::get_if<MeshAttributeTexture>(&texture);
    if (!attribute) return {};
    scene.effects |= {Effect::mesh_attribute};
    AttributeSlot slot{static_cast<std::int32_t>(scene.attributes.size()), attribute->name.starts_with("face_"), attribute->scale};
    for (std::size_t i = 0; i < scene.attribute_slots.size(); ++i)
        if (scene.attribute_slots[i].index >= 0 && std::get<MeshAttributeTexture>(scene.textures[i]).name == attribute->name)
            slot.index = scene.attribute_slots[i].index;
    if (slot.index == static_cast<std::int32_t>(scene.attributes.size())) scene.attributes.emplace_back();
    return slot;
}

}  // namespace

TextureRef texture_ref(Scene& scene, const Texture& texture) {
    if (const auto* constant = std::get_if<Rgb>(&texture)) return {*constant, -1};
    scene.textures.push_back(texture);
    scene.attribute_slots.push_back(attribute_slot(scene, texture));
    scene.effects |= {Effect::texture};
    return {Vec3f{0.0f}, static_cast<std::int32_t>(scene.textures.size() - 1)};
}

}  // namespace detail

const Shape& shape_of(const SceneDescription& compiled, std::uint32_t geometry) noexcept {
    std::size_t i = geometry;
    if (i < compiled.shapes.size()) return compiled.shapes[i];
    i -= compiled.shapes.size();
    std::size_t group = 0;
    for (; i >= compiled.groups[group].shapes.size(); ++group) i -= compiled.groups[group].shapes.size();
    return compiled.groups[group].shapes[i];
}

Scene compile(const SceneDescription& description) {
    Scene scene;
    scene.description = description;
    scene.film = description.film;
    if (scene.film.crop_width == 0) {
        scene.film.crop_width = scene.film.width;
        scene.film.crop_height = scene.film.height;
    }
    scene.camera = compile_camera(description.camera, scene.film);
    if (scene.camera.aperture_radius > 0.0f) scene.call_for({Effect::lens}, description.camera.where);
    const glm::dvec3 origin(description.camera.to_world[3]);
    const auto placements = detail::settle(scene.description);
    detail::compile_materials(scene);
    detail::compile_shapes(scene, origin);
    detail::compile_instances(scene, placements, origin);
    detail::compile_media(scene, origin);
    build_accelerator(scene);
    detail::compile_lights(scene, origin);
    scene.triangle_rows = triangle_rows(scene);
    scene.shading_rows = shading_rows(scene);
    return scene;
}

}  // namespace koksma
