// Light that is scattered once in a medium, three ways: by light sampling alone, by phase function sampling alone, and by the kernel, which
// does both. The first two choose the point by themselves and walk through the medium in a few lines of their own.

#include <koksma/scene/light_choice.h>
#include <koksma/scene/light_sampling.h>
#include <koksma/scene/medium/phase.h>

#include "media_scenes.h"

#include <scenes/lamps.h>
#include <scenes/uniform.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();
const Rgb kSigma(0.5f, 1.0f, 2.0f), kAlbedo(0.9f, 0.8f, 0.7f);

const glm::dvec3 kMiddle(-0.3, -0.15, 0.0);

/// A ball of fog, of radius 1, with a hidden lamp and something in the way of a part of the light.
SceneDescription scene_of(LampKind kind, double g, bool as_grid) {
    SceneDescription d = volume_scene(2);
    std::vector<float> same;
    for (int i = 0; i < 8; ++i)
        for (int c = 0; c < 3; ++c) same.push_back(kSigma[c]);
    add_medium(
        d,
        as_grid ? heterogeneous(grid(2, 2, 2, same), translated(kMiddle - 1.5) * scaled(3), kAlbedo, g) : homogeneous(kSigma, kAlbedo, g),
        SphereShape{}, translated(kMiddle));
    add_lamp(d, kind);
    add_shape(d, SphereShape{}, translated(kMiddle + glm::dvec3(-0.7, 0.9, 0.5)) * scaled(0.2), add_diffuse(d, 0.0f));
    look_narrowly(d, kMiddle + glm::dvec3(0.1, 0.2, 3), kMiddle + glm::dvec3(0.1, 0.2, 0), 1e-4);
    d.integrator.hide_emitters = true;
    return d;
}

/// One sample of light sampling or of phase function sampling: the point uniform on the chord.
class OneScattering {
public:
    OneScattering(const Scene& scene, double g) : scene_(scene), g_(static_cast<float>(g)), half_(std::sqrt(1.0 - 0.05)) {}

    [[nodiscard]] Vec3d by_light(Uniform& u) const {
        const Start s = start(u);
        const LightChoice choice = choose_light<kAll>(scene_, s.p, Vec3f(0.0f), u());
        const LightSample light = sample_light<kAll>(scene_, scene_.lights[choice.light], s.p, u.pair(), choice.triangle);
        if (!(light.pdf_w > 0.0f && choice.probability > 0.0f)) return {};
        const Vec3f to = light.target - s.p;
        Surface met;
        const auto [through, end] =
            walk(s.p, light.wi, light.at_infinity ? kInfinity : length(to) * (1.0f - 1e-4f), met);  // short of the light
        if (end) return {};
        return s.weight * through * to_double(light.radiance) *
               static_cast<double>(eval_phase(g_, light.wi.z) / (light.pdf_w * choice.probability));
    }
    [[nodiscard]] Vec3d by_phase(Uniform& u) const {
        const Start s = start(u);
        const Vec3f wi = sample_phase(g_, {0, 0, 1}, u.pair());
        Surface met;
        const auto [through, end] = walk(s.p, wi, kInfinity, met);
        const Vec3f sky = scene_.environment_light >= 0 ? environment_value(scene_, wi).radiance : Vec3f{0.0f};
        return s.weight * through * to_double(end ? emitted<kAll>(scene_, met, -wi) : sky);
    }

private:
    struct Start {
        Vec3f p;
        Vec3d weight;
    };
    [[nodiscard]] static Vec3d attenuated(double distance) {
        return {std::exp(-kSigma.r * distance), std::exp(-kSigma.g * distance), std::exp(-kSigma.b * distance)};
    }
    [[nodiscard]] Start start(Uniform& u) const {
        const double t = 2 * half_ * static_cast<double>(u());
        // Relative to the camera, which looks along -z at the ball 3 away.
        const Vec3f p{0.0f, 0.0f, static_cast<float>(half_ - t - 3)};
        return {p, attenuated(t) * Vec3d{kSigma.r * kAlbedo.r, kSigma.g * kAlbedo.g, kSigma.b * kAlbedo.b} * (2 * half_)};
    }
    /// Transmittance from p inside the ball, and whether a surface other than the ball's ends the way.
    [[nodiscard]] std::pair<Vec3d, bool> walk(Vec3f p, Vec3f d, float distance, Surface& met) const {
        const Vec3d center{-0.1, -0.2, -3.0}, f = to_double(p) - center;
        const double b = dot(f, to_double(d)), leaves = -b + std::sqrt(b * b - dot(f, f) + 1.0);
        Ray ray{p, d, 0.0f, distance};
        for (;;) {
            const Hit hit = scene_.accelerator.intersect(ray);
            if (!hit.valid()) return {attenuated(std::min(leaves, static_cast<double>(distance))), false};
            met = surface_at<kAll>(scene_, ray, hit);
            if (met.geometry != 0) return {attenuated(std::min(leaves, static_cast<double>(length(met.p - p)))), true};
            ray.o = offset_origin(met.p, met.p_error, met.ng, d);
            ray.t_far = distance == kInfinity ? kInfinity : distance - length(ray.o - p);
            if (!(ray.t_far > 0.0f)) return {attenuated(leaves), false};
        }
    }

    const Scene& scene_;
    float g_;
    double half_;
};

}  // namespace

TEST_CASE("light sampling, phase function sampling and the kernel agree, for every lamp and phase function", "[media]") {
    constexpr int kDraws = 1 << 16, kParts = 16;
    std::uint32_t seed = 1;
    for (const double g : {0.0, 0.6, -0.4, 0.9})
        for (const LampKind kind : kLampKinds)
            for (const bool as_grid : {false, true}) {
                if (as_grid && g != 0.6) continue;
                const SceneDescription d = scene_of(kind, g, as_grid);
                const Scene scene = compile(d);
                const OneScattering estimate(scene, g);
                Uniform u(seed++);
                std::vector<double> light[3], phase[3];
                for (int part = 0; part < kParts; ++part) {
                    Vec3d a, b;
                    for (int i = 0; i < kDraws / kParts; ++i) a = a + estimate.by_light(u), b = b + estimate.by_phase(u);
                    const double n = kDraws / kParts;
                    light[0].push_back(a.x / n), light[1].push_back(a.y / n), light[2].push_back(a.z / n);
                    phase[0].push_back(b.x / n), phase[1].push_back(b.y / n), phase[2].push_back(b.z / n);
                }
                const MeasuredRgb kernel = measure_rgb(d, as_grid ? 16384 : 2048, 8);
                const bool delta =
                    kind == LampKind::point || kind == LampKind::spot || kind == LampKind::projector || kind == LampKind::directional;
                for (int c = 0; c < 3; ++c) {
                    const Measured l = measured(light[c]), p = measured(phase[c]), &k = kernel.channel[c];
                    INFO("g " << g << " under " << kLampNames[static_cast<int>(kind)] << (as_grid ? " grid" : "") << " channel " << c
                              << ": light " << l.mean << " +- " << l.standard_error << ", phase " << p.mean << " +- " << p.standard_error
                              << ", kernel " << k.mean << " +- " << k.standard_error);
                    const auto agree = [](const Measured& a, const Measured& b) {
                        return std::fabs(a.mean - b.mean) <= std::hypot(a.noise(), b.noise()) + 2e-4 * std::fabs(b.mean);
                    };
                    CHECK(k.mean > 0.0);
                    CHECK(k.invalid == 0);
                    CHECK(k.standard_error <= 0.03 * k.mean);
                    CHECK(agree(l, k));
                    if (delta)
                        CHECK(p.mean == 0.0);
                    else if (g < 0.9 || p.mean > 0.0)
                        CHECK(agree(p, k));  // a narrow peak may find nothing of a small lamp
                }
            }
}
