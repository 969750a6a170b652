#pragma once
// One scene for each effect.

#include <koksma/plan/effect.h>

#include <scenes/describe.h>
#include <scenes/layered_materials.h>

#include <memory>
#include <utility>
#include <vector>

namespace koksma::testing {

/// A floor, a lamp of its own kind or the default, a camera above.
[[nodiscard]] inline SceneDescription floor_scene(bool lamp = true) {
    SceneDescription d = empty_scene(9, 7);
    add_shape(d, RectangleShape{}, scaled(3) * kUp, 0);
    if (lamp) add_light(d, RectangleShape{}, translated({0, 2, 0}) * scaled(0.5) * kDown, Rgb(3.0f));
    d.camera.to_world = look_at({0.3, 1.2, 2.5}, {0, 0.3, 0});
    d.camera.fov_x_degrees = 60;
    d.integrator.max_depth = 4;
    return d;
}

/// One of each kind of light without extent that is more than a point.
[[nodiscard]] inline std::vector<DeltaLight> delta_lights() {
    SpotLight spot;
    spot.to_world = look_at({0.2, 1.5, 0.1}, {0, 0, 0}, {1, 0, 0});
    spot.intensity = Rgb(3.0f, 2.0f, 1.0f);
    SpotLight slide = spot;
    slide.texture = CheckerboardTexture{Rgb(0.1f), Rgb(1.0f), glm::dmat3(4.0)};
    ProjectorLight projector;
    projector.to_world = spot.to_world;
    projector.irradiance = CheckerboardTexture{Rgb(0.1f), Rgb(1.0f), glm::dmat3(4.0)};
    projector.aspect = 1.5;
    return {spot, slide, projector, DirectionalLight{{0.3, -2.0, 0.1}, Rgb(1.0f, 2.0f, 3.0f), {}}};
}

/// A group of one shape of every kind, with materials that look at normals, at u and at slopes.
[[nodiscard]] inline ShapeGroup group_of_all_kinds(SceneDescription& d) {
    RoughConductor brushed;
    brushed.alpha_u = Rgb(0.4f);
    brushed.alpha_v = Rgb(0.1f);
    BitmapTexture waves;
    waves.image = image(4, 4,
                        {Rgb(0.1f), Rgb(0.8f), Rgb(0.3f), Rgb(0.5f), Rgb(0.9f), Rgb(0.2f), Rgb(0.4f), Rgb(0.6f), Rgb(0.0f), Rgb(0.7f),
                         Rgb(0.5f), Rgb(0.1f), Rgb(0.6f), Rgb(0.3f), Rgb(0.9f), Rgb(0.4f)});
    Material grey;
    grey.front = Diffuse{};
    BumpMap bump;
    bump.height = waves;
    bump.scale = 0.2f;
    bump.bending.nested = {grey};
    const std::uint32_t metal = add_material(d, brushed), both = add_diffuse(d, 0.7f, true),
                        checks = add_material(d, Diffuse{CheckerboardTexture{}}), bent = add_material(d, bump);
    SceneDescription g = empty_scene();
    add_shape(g, SphereShape{}, translated({0, 0.4, 0}) * scaled(0.3), bent);
    add_shape(g, CubeShape{}, translated({0.6, 0.2, 0}) * scaled(0.2), checks);
    add_shape(g, DiskShape{}, translated({-0.5, 0.5, 0.1}) * rotated({1, 0, 0}, -60) * scaled(0.25), metal);
    add_shape(g, CylinderShape{{0, 0, 0.5}, {0.3, 0.3, 0.5}, 0.1}, Matrix(1.0), both);
    add_shape(g, RectangleShape{}, translated({-0.5, 0.2, 0.5}) * rotated({0, 1, 0}, 30) * scaled(0.2), both);
    add_shape(
        g,
        mesh({{-0.3f, 0.8f, 0.2f}, {0.3f, 0.8f, 0.2f}, {0.3f, 0.9f, -0.2f}}, {{0, 1, 2}}, {{-0.3f, 1, 0}, {0.3f, 1, 0}, {0.3f, 1, 0.2f}}),
        Matrix(1.0), both);
    return {"group", std::move(g.shapes), {}};
}

/// A place for an instance, with what is hard about it.
[[nodiscard]] inline std::vector<Matrix> hard_placements() {
    return {translated({-0.9, 0, 0.2}), translated({0.9, 0.1, -0.3}) * rotated({0, 1, 0}, 70) * scaled({0.7, 1.6, 0.5}),
            translated({0.1, 0, 0.7}) * rotated({0.6, 0.8, 0}, 25) * scaled({-0.8, 0.5, 0.6})};
}

struct EffectScene {
    Effect effect;
    SceneDescription description;
};

[[nodiscard]] inline std::vector<EffectScene> effect_scenes() {
    std::vector<EffectScene> out;
    const auto add = [&](Effect e, SceneDescription d) { out.push_back({e, std::move(d)}); };
    SceneDescription d = floor_scene();
    d.camera.aperture_radius = 0.2;
    d.camera.focus_distance = 2.0;
    add(Effect::lens, d);

    d = floor_scene();
    add_light(d, RectangleShape{}, translated({1.5, 1, 0}) * rotated({0, 0, 1}, 70) * scaled(0.4) * kUp, Rgb(1.0f, 2.0f, 0.5f));
    add(Effect::light_choice, d);

    add(Effect::area_light, floor_scene());

    d = floor_scene(false);
    add_light(d, SphereShape{}, translated({0, 1, 0}) * scaled(0.3), Rgb(2.0f));
    add(Effect::sphere_light, d);

    d = floor_scene(false);
    d.point_lights.push_back({{0.2, 1.0, 0.1}, Rgb(1.0f, 2.0f, 3.0f), {}});
    add(Effect::point_light, d);
    for (const DeltaLight& light : delta_lights()) {
        d = floor_scene(false);
        d.delta_lights.push_back(light);
        add(Effect::point_light, d);
    }
    for (int i = 0; i < 20; ++i) d.point_lights.push_back({{0.2 * i - 2.0, 1.0, 0.1}, Rgb(0.1f), {}});
    d.delta_lights = delta_lights();
    d.environment = ConstantEnvironment{Rgb(0.1f), {}};
    add(Effect::many_lights, d);

    d = floor_scene(false);
    MapEnvironment m;
    m.image = image(4, 3, {Rgb(0.1f), Rgb(1.0f), Rgb(2.0f), Rgb(0.0f), Rgb(3.0f), Rgb(0.2f), Rgb(0.3f), Rgb(1.0f), Rgb(5.0f), Rgb(0.5f), Rgb(0.1f), Rgb(0.7f)});
    d.environment = m;
    add(Effect::environment, d);
    d.environment = ConstantEnvironment{};
    add(Effect::environment, d);
    // Sides that ask the sky for light and sides that do not, on one shape.
    for (const auto& [front, back] : {std::pair<OneSidedMaterial, OneSidedMaterial>{Diffuse{Rgb(0.6f)}, Diffuse{Rgb(0.3f)}},
                                      {Conductor{}, Diffuse{Rgb(0.3f)}},
                                      {Diffuse{Rgb(0.6f)}, Conductor{}}}) {
        d = floor_scene(false);
        d.environment = m;
        const std::uint32_t sided = add_material(d, front, true);
        d.materials[sided].back = back;
        add_shape(d, RectangleShape{}, translated({-0.5, 0.7, 0}) * rotated({1, 0, 0}, 150) * scaled(0.4), sided);
        add_shape(d, RectangleShape{}, translated({0.5, 0.7, 0}) * rotated({1, 0, 0}, -30) * scaled(0.4), sided);
        add(Effect::environment, d);
    }

    add(Effect::diffuse, floor_scene());

    d = floor_scene();
    RoughConductor metal;
    metal.distribution = RoughConductor::Distribution::ggx;
    metal.alpha_u = Rgb(0.3f);
    metal.alpha_v = Rgb(0.3f);
    const std::uint32_t rough = add_material(d, metal);
    add_shape(d, CubeShape{}, translated({0, 0.5, 0}) * scaled(0.4), rough);
    add(Effect::glossy, d);

    d = floor_scene();
    metal.alpha_v = Rgb(0.1f);
    const std::uint32_t brushed = add_material(d, metal);
    add_shape(d, CubeShape{}, translated({0, 0.5, 0}) * scaled(0.4), brushed);
    add(Effect::anisotropic, d);

    d = floor_scene();
    const std::uint32_t mirror = add_material(d, Conductor{});
    add_shape(d, CubeShape{}, translated({0, 0.5, 0}) * scaled(0.4), mirror);
    add(Effect::specular, d);

    d = floor_scene();
    const std::uint32_t glass = add_material(d, Dielectric{});
    add_shape(d, CubeShape{}, translated({0, 0.5, 0}) * scaled(0.4), glass);
    add(Effect::dielectric, d);
    add(Effect::lobe, d);
    d = floor_scene();
    const std::uint32_t window = add_material(d, ThinDielectric{});
    add_shape(d, CubeShape{}, translated({0, 0.5, 0}) * scaled(0.4), window);
    add(Effect::dielectric, d);

    for (const Material& layered_material : layered_materials()) {
        d = floor_scene();
        d.materials.push_back(layered_material);
        const auto layered = static_cast<std::uint32_t>(d.materials.size() - 1);
        add_shape(d, CubeShape{}, translated({-0.6, 0.5, 0}) * rotated({0, 1, 0}, 20) * scaled(0.3), layered);
        add_shape(d, SphereShape{}, translated({0.6, 0.5, 0}) * scaled(0.4), layered);
        add_shape(d, DiskShape{}, translated({0, 0.9, 0.4}) * rotated({1, 0, 0}, -60) * scaled(0.4), layered);
        d.integrator.max_depth = 8;
        add(Effect::layered, d);
    }

    for (const Technique t : {Technique::light, Technique::bsdf}) {
        d = floor_scene();
        d.integrator.technique = t;
        add(Effect::one_technique, d);
    }

    d = floor_scene();
    const std::uint32_t both = add_diffuse(d, 0.7f, true);
    add_shape(d, RectangleShape{}, translated({0, 0.7, 0}) * rotated({1, 0, 0}, 150) * scaled(0.5), both);
    add(Effect::two_sided, d);

    d = floor_scene();
    const std::uint32_t checks = add_material(d, Diffuse{CheckerboardTexture{}});
    d.shapes[0].material = checks;
    add(Effect::texture, d);

    d = floor_scene();
    add_shape(d, SphereShape{}, translated({-0.5, 0.4, 0}) * scaled(0.4), 0);
    add_shape(d, DiskShape{}, translated({0.6, 0.4, 0}) * rotated({1, 0, 0}, -60) * scaled(0.4), 0);
    add(Effect::analytic_shape, d);
    add_shape(d, CylinderShape{{0, 0.3, 0}, {0.3, 0.5, 0.2}, 0.2}, translated({0, 0.1, 0.4}), add_diffuse(d, 0.6f, true));
    add_light(d, CylinderShape{}, translated({0, 1.5, 0}) * scaled(0.1), Rgb(20.0f));
    add(Effect::analytic_shape, d);

    d = floor_scene();
    d.camera.orthographic = true;
    d.camera.to_world = d.camera.to_world * scaled({1.5, 1.2, 1});
    d.film.filter.kind = ReconstructionFilter::Kind::gaussian;
    add(Effect::diffuse, d);

    d = floor_scene();
    auto coloured = std::make_shared<MeshData>();
    coloured->positions = {{-1, 0.2f, 1}, {1, 0.2f, 1}, {1, 0.2f, -1}, {-1, 0.4f, -1}};
    coloured->triangles = {{0, 1, 2}, {0, 2, 3}};
    coloured->attributes = {{"vertex_color", {Rgb(0.9f, 0.1f, 0.1f), Rgb(0.1f, 0.9f, 0.1f), Rgb(0.1f, 0.1f, 0.9f), Rgb(0.5f)}}, {"face_grey", {Rgb(0.2f), Rgb(0.6f)}}};
    const std::uint32_t by_vertex = add_material(d, Diffuse{MeshAttributeTexture{"vertex_color", 0.5f}});
    const std::uint32_t by_face = add_material(d, Diffuse{MeshAttributeTexture{"face_grey", 1.0f}});
    add_shape(d, MeshShape{coloured}, Matrix(1.0), by_vertex);
    add_shape(d, MeshShape{coloured}, translated({0, 0.2, 0}) * scaled(0.3), by_face);
    add(Effect::mesh_attribute, d);

    d = floor_scene();
    add_shape(d, mesh({{-1, 0.2f, 1}, {1, 0.2f, 1}, {1, 0.2f, -1}, {-1, 0.2f, -1}}, {{0, 1, 2}, {0, 2, 3}}, {{-0.3f, 1, 0}, {0.3f, 1, 0}, {0.3f, 1, 0.2f}, {-0.3f, 1, 0}}),
              Matrix(1.0), 0);
    add(Effect::shading_normals, d);

    d = floor_scene();
    d.integrator.max_depth = -1;
    d.integrator.rr_depth = 2;
    add(Effect::roulette, d);

    d = floor_scene(false);
    for (int i = 0; i < 24; ++i)
        add_light(d, RectangleShape{}, translated({0.2 * i - 2.4, 1 + 0.1 * (i % 5), 0.3 * (i % 3)}) * scaled(0.05) * kDown, Rgb(9.0f, 1.0f + static_cast<float>(i), 3.0f));
    add(Effect::many_lights, d);
    // One light of many triangles: the choice of a triangle takes the slot of the choice of a light.
    d = floor_scene(false);
    std::vector<glm::vec3> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < 40; ++i) {
        const float x = 0.1f * static_cast<float>(i) - 2.0f;
        for (const glm::vec3 v : {glm::vec3(x, 1.0f, 0.0f), glm::vec3(x + 0.08f, 1.0f, 0.0f), glm::vec3(x, 1.1f, 0.2f)}) corners.push_back(v);
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    add_light(d, mesh(corners, triangles), Matrix(1.0), Rgb(5.0f));
    add(Effect::many_lights, d);

    d = floor_scene();
    d.groups.push_back(group_of_all_kinds(d));
    for (const Matrix& place : hard_placements()) d.instances.push_back({0, place, {}, {}});
    add(Effect::instancing, d);

    d.camera.shutter_open = 0.25;
    d.camera.shutter_close = 1.0;
    for (Instance& i : d.instances)
        i.animation = {
            {0.0, i.to_world}, {0.5, i.to_world * rotated({0, 1, 0}, 50)}, {1.0, translated({0.1, 0.2, 0}) * i.to_world * scaled(1.2)}};
    d.instances[0].animation.clear();
    Shape& wheel = add_shape(d, CubeShape{}, Matrix(1.0), 0);
    wheel.animation = {{0.0, translated({0, 1.2, -1}) * scaled(0.2)},
                       {1.0, translated({0, 1.2, -1}) * rotated({0, 0, 1}, 100) * scaled(0.2)}};
    add_shape(d, SphereShape{}, Matrix(1.0), 0).animation = {{0.0, translated({-1, 0.4, 1}) * scaled(0.2)},
                                                             {1.0, translated({-1, 1.0, 1}) * scaled(0.2)}};
    add(Effect::motion, d);

    const auto with_box = [](bool heterogeneous, Rgb sigma_t) {
        SceneDescription box = floor_scene();
        box.integrator.volumetric = true;
        Medium fog;
        fog.heterogeneous = heterogeneous;
        fog.sigma_t = ConstantVolume{sigma_t, translated({-0.5, 0, -0.5})};
        if (heterogeneous) fog.sigma_t = GridVolume{grid(2, 2, 1, {0.0f, 1.0f, 2.0f, 0.5f}), GridVolume::Filter::trilinear, GridVolume::Wrap::clamp, translated({-0.5, 0, -0.5})};
        fog.g = 0.4;
        box.media = {fog};
        const std::uint32_t nothing = add_material(box, Null{});
        add_shape(box, CubeShape{}, translated({0, 0.5, 0}) * scaled(0.5), nothing).interior = 0;
        return box;
    };
    add(Effect::medium, with_box(false, Rgb(1.0f)));
    add(Effect::medium, with_box(false, Rgb(0.2f, 1.0f, 3.0f)));
    add(Effect::heterogeneous, with_box(true, Rgb(1.0f)));
    add(Effect::null_boundary, with_box(false, Rgb(1.0f)));
    d = floor_scene();
    d.integrator.volumetric = true;
    Material leaf;
    leaf.front = Diffuse{};
    const std::uint32_t leaves = add_material(d, Mask{Rgb(0.4f), {leaf}});
    for (int i = 0; i < 3; ++i) add_shape(d, RectangleShape{}, translated({0.2 * i - 0.2, 0.5 + 0.2 * i, 0}) * kUp * scaled(0.5), leaves);
    add(Effect::mask, d);
    return out;
}

}  // namespace koksma::testing
