// Direct light three ways: by light sampling, by BSDF sampling, and by both with the power heuristic. Each is an estimate of one
// integral; a density that lies shows in the third even where the first two are right.

#include <koksma/scene/light_choice.h>
#include <koksma/scene/light_sampling.h>

#include "lamps.h"
#include "render_scene.h"
#include "uniform.h"

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();

struct Case {
    std::string name;
    OneSidedMaterial material;
    bool two_sided = false, from_behind = false, from_below = false;
};

std::vector<Case> cases() {
    const auto rough = [](RoughConductor::Distribution distribution, float u, float v) {
        RoughConductor r;
        r.distribution = distribution;
        r.alpha_u = Rgb(u);
        r.alpha_v = Rgb(v);
        r.base.perfect = false;
        r.base.eta = Rgb(1.66f, 0.88f, 0.52f);
        r.base.k = Rgb(9.2f, 6.3f, 4.8f);
        return r;
    };
    using enum RoughConductor::Distribution;
    const auto rough_glass = [](Facets distribution, float u, float v) {
        RoughDielectric r;
        r.distribution = distribution;
        r.alpha_u = Rgb(u);
        r.alpha_v = Rgb(v);
        return r;
    };
    RoughPlastic rough_plastic;
    rough_plastic.alpha = 0.2f;
    Principled sliders;
    sliders.base_color = Rgb(0.3f, 0.6f, 0.2f);
    for (Texture* t : {&sliders.metallic, &sliders.spec_trans, &sliders.spec_tint, &sliders.sheen, &sliders.sheen_tint, &sliders.flatness, &sliders.clearcoat, &sliders.anisotropic})
        *t = Rgb(0.4f);
    const auto nested = [](OneSidedMaterial m) {
        Material out;
        out.front = std::move(m);
        return out;
    };
    const Blend blend{Rgb(0.4f), {nested(Plastic{}), nested(rough_glass(ggx, 0.4f, 0.4f))}};
    const NormalMap normal_map{Rgb(0.6f, 0.45f, 0.9f), {true, true, {nested(rough(ggx, 0.3f, 0.3f))}}};
    BumpMap bump_map;
    BitmapTexture hills;
    // Of even sides: the middle, which is looked at, is no texel's centre, where slopes jump.
    hills.image = image(4, 2, {Rgb(0.1f), Rgb(0.5f), Rgb(0.2f), Rgb(0.7f), Rgb(0.0f), Rgb(0.3f), Rgb(0.4f), Rgb(0.1f)});
    bump_map.height = hills;
    bump_map.scale = 2.0f;
    bump_map.bending.nested = {nested(rough_plastic)};
    return {{"rough glass, ggx 0.4", rough_glass(ggx, 0.4f, 0.4f)},
            {"rough glass, beckmann 0.3 x 0.5", rough_glass(beckmann, 0.3f, 0.5f)},
            {"rough glass, ggx 0.5, from below", rough_glass(ggx, 0.5f, 0.5f), false, false, true},
            {"rough glass, beckmann 0.4, upside down, from below", rough_glass(beckmann, 0.4f, 0.4f), false, true, true},
            {"plastic", Plastic{}},
            {"two-sided plastic from behind", Plastic{}, true, true},
            {"rough plastic", rough_plastic},
            {"principled", sliders},
            {"principled from below", sliders, false, false, true},
            {"blend of plastic and rough glass", blend},
            {"mask of rough plastic", Mask{Rgb(0.7f), {nested(rough_plastic)}}},
            {"normal map", normal_map},
            {"bump map", bump_map},
            {"diffuse", Diffuse{Rgb(0.7f)}},
            {"ggx 0.7", rough(ggx, 0.7f, 0.7f)},
            {"ggx 0.2", rough(ggx, 0.2f, 0.2f)},
            {"ggx 0.03", rough(ggx, 0.03f, 0.03f)},
            {"ggx 0.4 x 0.1", rough(ggx, 0.4f, 0.1f)},
            {"beckmann 0.5", rough(beckmann, 0.5f, 0.5f)},
            {"beckmann 0.1", rough(beckmann, 0.1f, 0.1f)},
            {"beckmann 0.1 x 0.3", rough(beckmann, 0.1f, 0.3f)},
            {"two-sided diffuse from behind", Diffuse{Rgb(0.7f)}, true, true},
            {"two-sided ggx 0.2 from behind", rough(ggx, 0.2f, 0.2f), true, true}};
}

SceneDescription scene_of(const Case& c, LampKind kind) {
    SceneDescription d = empty_scene();
    const std::uint32_t m = add_material(d, c.material, c.two_sided);
    add_shape(d, RectangleShape{}, scaled(2) * (c.from_behind ? kDown : kUp), m);
    add_lamp(d, kind);
    // Something in the way of a part of the light.
    const std::uint32_t black = add_diffuse(d, 0.0f);
    add_shape(d, SphereShape{}, translated({-0.7, 0.7, 0.4}) * scaled(0.15), black);
    look_narrowly(d, {1.1, c.from_below ? -1.2 : 1.2, 0}, {0, 0, 0}, 1e-4);
    d.integrator.max_depth = 2;
    return d;
}

/// The three estimates at the point that the camera sees.
class Point {
public:
    explicit Point(const Scene& scene) : scene_(scene) {
        const auto c = camera_ray<float>(scene.camera, film_point(scene.camera, 0, 0, {0.5f, 0.5f}), {0.5f, 0.5f});
        const Ray ray{c.o, c.d, c.t_near, c.t_far};
        surface_ = surface_at<kAll>(scene, ray, scene.accelerator.intersect(ray));
        local_ = bsdf_at<kAll>(scene, surface_, -ray.d);
        wo_ = local_.frame.to_local(-ray.d);
    }
    /// One sample of light sampling, weighted or not; green.
    [[nodiscard]] double by_light(Uniform& u, bool weighted) const {
        const LightChoice choice = choose_light<kAll>(scene_, surface_.p, lit_normal_of<kAll>(local_, wo_), u());
        const LightSample s = sample_light<kAll>(scene_, scene_.lights[choice.light], surface_.p, u.pair(), choice.triangle);
        if (!(s.pdf_w > 0.0f && choice.probability > 0.0f)) return 0.0;
        const BsdfValue f = eval_local<kAll>(scene_, local_, wo_, local_.frame.to_local(s.wi));
        if (!(max_component(f.f_cos) > 0.0f)) return 0.0;
        Ray shadow;
        shadow.o = offset_origin(surface_.p, surface_.p_error, surface_.ng, s.wi);
        shadow.d = s.at_infinity ? s.wi : s.target - shadow.o;
        shadow.t_far = s.at_infinity ? kInfinity : 1.0f;
        if (scene_.accelerator.occluded(shadow)) return 0.0;
        const float pdf = s.pdf_w * choice.probability;
        return f.f_cos.y * s.radiance.y / pdf * (weighted && !s.delta ? power_heuristic(pdf, f.pdf_w) : 1.0f);
    }
    /// @param delta_only  the part that light sampling cannot find
    [[nodiscard]] double by_bsdf(Uniform& u, bool weighted, bool delta_only = false) const {
        const BsdfSample s = sample_local<kAll>(scene_, local_, wo_, u(), u.pair());
        if (!(s.pdf_w > 0.0f) || (delta_only && !s.delta)) return 0.0;
        weighted = weighted && !s.delta;
        const Vec3f wi = local_.frame.to_world(s.wi);
        const Ray ray{offset_origin(surface_.p, surface_.p_error, surface_.ng, wi), wi};
        const Hit hit = scene_.accelerator.intersect(ray);
        Vec3f le{0.0f};
        float pdf_light = 0.0f;
        if (hit.valid()) {
            const Surface there = surface_at<kAll>(scene_, ray, hit);
            le = emitted<kAll>(scene_, there, -wi);
            if (!(max_component(le) > 0.0f)) return 0.0;
            const auto light = static_cast<std::uint32_t>(scene_.geometries[there.geometry].light);
            const std::uint32_t triangle = chosen_triangle<kAll>(scene_, light, hit.primitive);
            pdf_light = light_pdf<kAll>(scene_, scene_.lights[light], surface_.p, there, wi, triangle) * probability(light, triangle);
        } else if (scene_.environment_light >= 0) {
            const EnvironmentValue sky = environment_value(scene_, wi);
            le = sky.radiance;
            pdf_light = sky.pdf_w * probability(static_cast<std::uint32_t>(scene_.environment_light), kWholeLight);
        }
        return s.weight.y * le.y * (weighted ? power_heuristic(s.pdf_w, pdf_light) : 1.0f);
    }

private:
    [[nodiscard]] float probability(std::uint32_t light, std::uint32_t triangle) const {
        return choice_probability<kAll>(scene_, light, triangle, surface_.p, lit_normal_of<kAll>(local_, wo_));
    }

    const Scene& scene_;
    Surface surface_;
    LocalBsdf local_;
    Vec3f wo_;
};

/// Mean and standard error of n independent draws.
template <class F>
Measured average(int n, F&& draw) {
    double sum = 0, squares = 0;
    for (int i = 0; i < n; ++i) {
        const double x = draw();
        sum += x;
        squares += x * x;
    }
    Measured m;
    m.mean = sum / n;
    m.standard_error = std::sqrt(std::max(0.0, squares / n - m.mean * m.mean) / (n - 1));
    m.replicates = n;
    return m;
}

}  // namespace

TEST_CASE("light sampling, BSDF sampling and both agree with the path kernel, for every light and BSDF", "[scenes]") {
    constexpr int kDraws = 1 << 15;
    std::uint32_t seed = 1;
    for (const Case& c : cases())
        for (const LampKind kind : kLampKinds) {
            const Ready ready(scene_of(c, kind));
            const Point point(ready.scene);
            Uniform u(seed++);
            const Measured light = average(kDraws, [&] { return point.by_light(u, false) + point.by_bsdf(u, false, true); });
            const Measured bsdf = average(kDraws, [&] { return point.by_bsdf(u, false); });
            const Measured both = average(kDraws, [&] { return point.by_light(u, true) + point.by_bsdf(u, true); });
            const Measured kernel = measure(ready, 2048, 8);
            INFO(c.name << " under " << kLampNames[static_cast<int>(kind)] << ": light " << light.mean << " +- " << light.standard_error << ", BSDF " << bsdf.mean
                        << " +- " << bsdf.standard_error << ", both " << both.mean << " +- " << both.standard_error << ", kernel " << kernel.mean
                        << " +- " << kernel.standard_error);
            // Five standard errors of the difference, and 2e-4 for float.
            const auto agree = [](const Measured& a, const Measured& b) {
                return std::fabs(a.mean - b.mean) <= 5.0 * std::hypot(a.standard_error, b.standard_error) + 2e-4 * std::fabs(b.mean);
            };
            CHECK(kernel.mean > 0.0);
            CHECK(kernel.invalid == 0);
            CHECK(agree(light, kernel));
            CHECK(ready.plan.effects.has(Effect::many_lights) == (kind == LampKind::many));
            if (kind == LampKind::point || kind == LampKind::spot || kind == LampKind::projector || kind == LampKind::directional) {
                CHECK(bsdf.mean == 0.0);
            } else {
                CHECK(agree(bsdf, kernel));
                CHECK(agree(bsdf, light));
            }
            CHECK(agree(both, kernel));
            CHECK(both.standard_error <= 0.025 * both.mean);
        }
}

TEST_CASE("light sampling and light_pdf give one density", "[scenes]") {
    for (const LampKind kind : {LampKind::rectangle, LampKind::sphere, LampKind::inward_sphere, LampKind::disk, LampKind::mesh, LampKind::textured, LampKind::cylinder, LampKind::inward_cylinder}) {
        const Ready ready(scene_of(cases()[0], kind));
        const Vec3f p{-1.1f, -1.15f, 0.0f};  // relative to the camera: 5 cm above the middle of the floor
        const Light& light = ready.scene.lights[0];
        Uniform u(7);
        double worst = 0;
        int tested = 0;
        for (int i = 0; i < 4000; ++i) {
            const LightSample s = sample_light<kAll>(ready.scene, light, p, u.pair());
            if (!(s.pdf_w > 0.0f)) continue;
            const Ray ray{p, s.wi};
            const Hit hit = ready.scene.accelerator.intersect(ray);
            if (!hit.valid() || hit.geometry != light.geometry) continue;
            const Surface there = surface_at<kAll>(ready.scene, ray, hit);
            const bool curved = kind == LampKind::cylinder || kind == LampKind::inward_cylinder;  // where the normal turns with the error, too
            if (std::fabs(dot(there.ng, s.wi)) < (curved ? 0.2f : 0.02f)) continue;  // there the density per area is ill-conditioned
            worst = std::max(worst, std::fabs(double{light_pdf<kAll>(ready.scene, light, p, there, s.wi)} / s.pdf_w - 1.0));
            ++tested;
        }
        INFO(kLampNames[static_cast<int>(kind)] << ": worst relative difference " << worst << " of " << tested);
        CHECK(tested > 500);
        // Directions in float, 6e-8, over a cosine of 0.02 and more.
        CHECK(worst < 5e-5);
    }
}
