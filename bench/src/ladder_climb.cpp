#include "ladder.h"
#include "ladder_scenes.h"

#include <koksma/integrators/render.h>
#include <koksma/scene/scene.h>

#include <cmath>

namespace koksma {

LadderResult climb(const LadderStep& step, Technique technique, const Registry& registry, int threads) {
    SceneDescription description = step.scene;
    description.integrator.technique = technique;
    const Scene scene = compile(description);
    const RenderPlan plan = make_plan(scene, description.integrator);
    RenderOptions options;
    options.threads = threads;
    std::vector<double> means;
    LadderResult result;
    for (int r = 0; r < step.replicates; ++r) {
        const auto source = registry.make(step.sampler)->bind(sampling_plan(scene, plan, step.spp, static_cast<std::uint64_t>(r) + 1));
        const RenderResult rendered = render(scene, plan, *source, {crop_of(scene.film), step.first, step.spp}, options);
        means.push_back(rendered.film.mean().y / step.expected);
        result.invalid += rendered.stats.invalid_samples;
    }
    const Moments m = moments(means);
    result.error = m.mean - 1.0;
    result.half_width = student_t_factor(0.99, m.n - 1) * std::sqrt(m.variance / m.n);
    // Where no sample has met the light, nothing is known: replicates that agree on 0 are no interval.
    if (m.mean == 0.0) result.half_width = 1.0;
    return result;
}

namespace {

/// Every number is 0, 2^-24, 1/2, 1 - 2^-24 or any other, with equal chances.
class ExtremeSampler {
public:
    struct Point {
        Key key;
        [[nodiscard]] float number(std::uint32_t dimension) const noexcept {
            const std::uint32_t word = keyed_hash(key, dimension);
            constexpr float kEnds[] = {0.0f, 0x1p-24f, 0.5f, kOneMinusUlp};
            return word % 5 < 4 ? kEnds[word % 5] : unit_float(keyed_hash(key, ~dimension));
        }
        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return number(slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept { return {number(slot.dimension), number(slot.dimension + 1)}; }
    };
    [[nodiscard]] static SamplerInfo info() { return {.name = "extremes", .title = "Ends of [0, 1)", .paper = "none"}; }
    ExtremeSampler(const SamplerOptions&, const SamplingPlan& plan) noexcept : seed_(plan.seed) {}
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {derive_key(pixel_key(seed_, pixel), index)}; }

private:
    std::uint64_t seed_;
};

using namespace ladder;

/// A sphere of a material on a floor of it, under lamps of every kind and a sky with a bright texel.
SceneDescription everything_with(OneSidedMaterial material) {
    SceneDescription scene = empty_scene(4);
    const std::uint32_t m = add_material(scene, std::move(material));
    add_shape(scene, RectangleShape{}, scaled(3) * facing_up(), m);
    add_shape(scene, SphereShape{}, translated({0, 0.5, 0}) * scaled(0.5), m);
    add_shape(scene, CubeShape{}, translated({1.2, 0.3, 0.2}) * scaled(0.3), m);
    add_light(scene, RectangleShape{}, translated({0, 2, 0}) * facing_down(), 2.0);
    add_light(scene, SphereShape{}, translated({-1.2, 1, 0}) * scaled(0.2), 5.0);
    add_light(scene, DiskShape{}, translated({0, 1.6, 1.5}) * facing_down() * scaled(0.3), 3.0);
    add_light(scene, CylinderShape{{0, 0, 0}, {0.5, 0, 0}, 0.05}, translated({0, 1.2, -1}), 4.0);
    scene.point_lights.push_back({{0.5, 1.5, 0.5}, Rgb(0.5f), {}});
    auto sky = std::make_shared<Image>();
    sky->width = 16;
    sky->height = 8;
    sky->texels.assign(128, Rgb(0.1f));
    sky->texels[37] = Rgb(1e3f);
    scene.environment = MapEnvironment{sky, 1.0f, glm::dmat4(1.0), {}};
    scene.camera.to_world = look_at({0.3, 1.1, 3}, {0, 0.4, 0});
    scene.camera.aperture_radius = 0.1;
    scene.camera.focus_distance = 3.0;
    scene.integrator.max_depth = 12;
    return scene;
}

}  // namespace

std::vector<ExtremeResult> sweep_extremes(std::uint64_t samples, int threads) {
    Registry registry;
    registry.add<ExtremeSampler>();
    const auto sampler = registry.make("extremes");
    RoughConductor metal, sharp;
    metal.distribution = sharp.distribution = Facets::ggx;
    sharp.alpha_u = sharp.alpha_v = Rgb(1e-4f);
    RoughConductor beckmann;
    beckmann.alpha_u = Rgb(0.4f);
    beckmann.alpha_v = Rgb(0.05f);
    RoughDielectric rough_glass;
    rough_glass.distribution = Facets::ggx;
    RoughDielectric matched = rough_glass;
    matched.int_ior = 1.0f + 1e-6f;
    matched.ext_ior = 1.0f;
    matched.alpha_u = matched.alpha_v = Rgb(1e-4f);
    Principled principled;
    for (Texture* t : {&principled.metallic, &principled.spec_trans, &principled.sheen, &principled.flatness, &principled.clearcoat,
                       &principled.anisotropic})
        *t = Rgb(0.5f);
    const std::pair<const char*, OneSidedMaterial> materials[] = {{"diffuse", Diffuse{Rgb(1.0f)}},
                                                                  {"mirror", Conductor{}},
                                                                  {"GGX 0.1", metal},
                                                                  {"GGX 1e-4", sharp},
                                                                  {"Beckmann 0.4 x 0.05", beckmann},
                                                                  {"glass", Dielectric{}},
                                                                  {"thin glass", ThinDielectric{}},
                                                                  {"rough glass", rough_glass},
                                                                  {"index-matched rough glass", matched},
                                                                  {"plastic", Plastic{}},
                                                                  {"rough plastic", RoughPlastic{}},
                                                                  {"principled", principled}};
    std::vector<ExtremeResult> results;
    for (const auto& [name, material] : materials) {
        const SceneDescription description = everything_with(material);
        const Scene scene = compile(description);
        const RenderPlan plan = make_plan(scene, description.integrator);
        const std::uint64_t spp = samples / 16;
        const auto source = sampler->bind(sampling_plan(scene, plan, spp, 1));
        RenderOptions options;
        options.threads = threads;
        const RenderResult r = render(scene, plan, *source, {crop_of(scene.film), 0, spp}, options);
        ExtremeResult e{name, spp * 16, r.stats.invalid_samples, 0};
        for (std::int32_t y = 0; y < 4; ++y)
            for (std::int32_t x = 0; x < 4; ++x) e.brightest = std::max(e.brightest, r.film.mean({x, y}).y);
        results.push_back(e);
    }
    return results;
}

}  // namespace koksma
