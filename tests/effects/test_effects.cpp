// One scene for each effect.

#include <scenes/layered_materials.h>
#include <scenes/render_scene.h>

#include <koksma/integrators/replay.h>
#include <koksma/sampling/error.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// A floor, a lamp of its own kind or the default, a camera above.
SceneDescription floor_scene(bool lamp = true) {
    SceneDescription d = empty_scene(9, 7);
    add_shape(d, RectangleShape{}, scaled(3) * kUp, 0);
    if (lamp) add_light(d, RectangleShape{}, translated({0, 2, 0}) * scaled(0.5) * kDown, Rgb(3.0f));
    d.camera.to_world = look_at({0.3, 1.2, 2.5}, {0, 0.3, 0});
    d.camera.fov_x_degrees = 60;
    d.integrator.max_depth = 4;
    return d;
}

struct EffectScene {
    Effect effect;
    SceneDescription description;
};

std::vector<EffectScene> effect_scenes() {
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

    d = floor_scene(false);
    MapEnvironment m;
    m.image = image(4, 3, {Rgb(0.1f), Rgb(1.0f), Rgb(2.0f), Rgb(0.0f), Rgb(3.0f), Rgb(0.2f), Rgb(0.3f), Rgb(1.0f), Rgb(5.0f), Rgb(0.5f), Rgb(0.1f), Rgb(0.7f)});
    d.environment = m;
    add(Effect::environment, d);
    d.environment = ConstantEnvironment{};
    add(Effect::environment, d);

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
    return out;
}

}  // namespace

TEST_CASE("a scene's effects are found and give the path its slots", "[effects]") {
    int seen = 0;
    for (const EffectScene& s : effect_scenes()) {
        const Ready ready(s.description);
        INFO(name(s.effect));
        CHECK(ready.plan.effects.has(s.effect));
        seen |= 1 << static_cast<int>(s.effect);
        const auto has_slot = [&](SlotRole role) {
            for (const Slot& slot : ready.plan.layout.slots())
                if (slot.role == role) return true;
            return false;
        };
        const EffectSet e = ready.plan.effects;
        CHECK(has_slot(SlotRole::film));
        CHECK(has_slot(SlotRole::lens) == e.has(Effect::lens));
        CHECK(has_slot(SlotRole::light_choice) == e.has(Effect::light_choice));
        CHECK(has_slot(SlotRole::lobe) == e.has(Effect::lobe));
        CHECK(has_slot(SlotRole::roulette) == e.has(Effect::roulette));
        CHECK(has_slot(SlotRole::light_position) == (e.has(Effect::area_light) || e.has(Effect::environment)));
    }
    CHECK(seen == (1 << kEffectCount) - 1);
}

TEST_CASE("all admissible kernels give the same bytes on a scene for each effect", "[effects]") {
    for (const EffectScene& s : effect_scenes()) {
        const Ready ready(s.description);
        const Film chosen = ready.render(kSobol, 70, 11).film;
        CHECK(chosen.mean().y > 0.0);
        int admissible = 0;
        for (const Kernel& kernel : kernels()) {
            if (!kernel.effects.contains(ready.plan.effects)) {
                CHECK_THROWS_AS(find_kernel(kernel.name, ready.plan.effects), Error);
                continue;
            }
            ++admissible;
            RenderOptions o;
            o.kernel = &kernel;
            const RenderResult r = ready.render(kSobol, 70, 11, o);
            INFO(name(s.effect) << " with " << kernel.name);
            CHECK(same_bytes(chosen, r.film));
            CHECK(r.stats.invalid_samples == 0);
        }
        CHECK(admissible >= 1);
    }
}

TEST_CASE("a replayed path has the radiance that the render added", "[effects]") {
    for (const EffectScene& s : effect_scenes()) {
        SceneDescription d = s.description;
        const Ready ready(d);
        const RenderResult r = ready.render(kSobol, 1, 13);
        const auto source = samplers().make(kSobol)->bind(sampling_plan(ready.scene, ready.plan, 1, 13));
        for (const Pixel p : {Pixel{4, 3}, Pixel{2, 5}}) {
            const std::string text = replay(ready.scene, ready.plan, *source, {p, 0});
            char expected[128];
            const Vec3d m = r.film.mean(p);
            std::snprintf(expected, sizeof expected, "radiance    (%.9g, %.9g, %.9g)", m.x, m.y, m.z);
            INFO(name(s.effect) << "\n" << text << "\n" << expected);
            CHECK(text.find(expected) != std::string::npos);
        }
    }
}

TEST_CASE("a material that no shape uses calls for no effect", "[effects]") {
    SceneDescription d = floor_scene();
    static_cast<void>(add_material(d, Dielectric{}));
    CHECK_FALSE(Ready(d).plan.effects.has(Effect::dielectric));
}
