// Surfaces that let light pass straight on, crossed without a bounce.

#include "media_scenes.h"

#include <koksma/scene/bsdf/passage.h>
#include <koksma/scene/surface.h>

#include <scenes/uniform.h>

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();

Material nested(OneSidedMaterial m) {
    Material out;
    out.front = std::move(m);
    return out;
}

/// A lamp over a floor with `n` sheets between them.
SceneDescription sheets(const OneSidedMaterial& material, int n) {
    SceneDescription d = volume_scene(2);
    add_shape(d, RectangleShape{}, scaled(5) * kUp, 0);
    d.point_lights.push_back({{0, 3, 0}, Rgb(6.0f), {}});
    const std::uint32_t m = add_material(d, material);
    for (int i = 0; i < n; ++i) add_shape(d, RectangleShape{}, translated({0, 1.2 + 0.2 * i, 0}) * scaled(2) * kUp, m);
    look_narrowly(d, {4, 0.5, 0}, {0, 0, 0}, 1e-3);
    return d;
}

std::vector<std::pair<const char*, OneSidedMaterial>> passing() {
    RoughDielectric frost;
    frost.alpha_u = frost.alpha_v = Rgb(0.4f);
    return {{"mask", Mask{Rgb(0.3f), {nested(Diffuse{Rgb(0.8f)})}}},
            {"thin glass", ThinDielectric{}},
            {"mask of thin glass", Mask{Rgb(0.6f), {nested(ThinDielectric{})}}},
            {"blend of nothing and plastic", Blend{Rgb(0.7f), {nested(Null{}), nested(Plastic{})}}},
            {"blend of a mask and frosted glass", Blend{Rgb(0.4f), {nested(Mask{Rgb(0.5f), {nested(Diffuse{})}}), nested(frost)}}}};
}

}  // namespace

TEST_CASE("a lamp shines through sheets by the product of what they let pass", "[media]") {
    const double clear = 0.5 / std::numbers::pi * 6 / 9;
    check_mean(measure(sheets(Null{}, 3), 16), clear, 1e-5);
    check_mean(measure(sheets(Mask{Rgb(0.3f), {nested(Diffuse{})}}, 3), 16), clear * 0.7 * 0.7 * 0.7, 1e-5);
    const double once = std::pow((1.5046 / 1.000277 - 1) / (1.5046 / 1.000277 + 1), 2), glass = 1 - 2 * once / (1 + once);
    check_mean(measure(sheets(ThinDielectric{}, 2), 16), clear * glass * glass, 1e-5);
    check_mean(measure(sheets(Diffuse{}, 1), 16), 0.0, 0.0);
    // For the surface integrator they are opaque to shadow rays.
    SceneDescription d = sheets(Null{}, 1);
    d.integrator.volumetric = false;
    check_mean(measure(d, 16), 0.0, 0.0);
}

TEST_CASE("crossing is no bounce", "[media]") {
    for (const int n : {0, 1, 7}) {
        SceneDescription d = volume_scene(1);
        add_light(d, RectangleShape{}, scaled(5) * kUp, Rgb(2.0f));
        const std::uint32_t nothing = add_material(d, Null{});
        for (int i = 0; i < n; ++i) add_shape(d, RectangleShape{}, translated({0, 0.5 + 0.2 * i, 0}) * scaled(2) * kUp, nothing);
        look_narrowly(d, {0.1, 4, 0.2}, {0, 0, 0});
        check_mean(measure(d, 4), 2.0, 1e-6);
    }
}

TEST_CASE("what passes and what is stopped are all that a material does", "[media]") {
    for (const auto& [name, material] : passing()) {
        SceneDescription d = volume_scene();
        add_shape(d, RectangleShape{}, kUp, add_material(d, material));
        const Scene scene = compile(d);
        LayeredPoint at;
        at.side = scene.materials.at(scene.geometries.at(0).material).front;
        for (const Vec3f wo : {normalize(Vec3f{0.3f, 0.1f, 0.9f}), normalize(Vec3f{-0.8f, 0.2f, -0.3f})}) {
            const Passage passage = passage_at(scene, at, wo);
            const LocalBsdf local{bsdf_of<kAll>(scene, scene.sides.at(at.side), {}), Frame::from_normal({0, 0, 1}), at};
            Uniform u(21);
            constexpr int kDraws = 200000;
            // Share and mean of the direction of what is left when the straight ones are taken out of all samples, against sample_stopped.
            double straight = 0, straight_weight = 0, rest[4] = {}, stopped[4] = {};
            for (int i = 0; i < kDraws; ++i) {
                const float u_lobe = u();
                const Vec2f u_direction = u.pair();
                const BsdfSample s = sample_local<kAll>(scene, local, wo, u_lobe, u_direction);
                const auto tally = [&](const BsdfSample& b, double(&into)[4]) {
                    if (!(b.pdf_w > 0.0f)) return;
                    const double w = b.weight.y;
                    into[0] += w, into[1] += w * b.wi.x, into[2] += w * b.wi.y, into[3] += w * b.wi.z;
                };
                if (s.delta && length(s.wi + wo) < 1e-6f)
                    straight += 1, straight_weight += s.weight.y;
                else
                    tally(s, rest);
                const BsdfSample t = sample_stopped(scene, at, wo, u_lobe, u_direction);
                CHECK_FALSE((t.delta && t.pdf_w > 0.0f && length(t.wi + wo) < 1e-6f));
                tally(t, stopped);
            }
            INFO(name << " wo.z " << wo.z << " passes " << passage.probability);
            const double p = passage.probability, sigma = std::sqrt(p * (1 - p) / kDraws);
            CHECK(std::fabs(straight / kDraws - p) < 5 * sigma + 1e-6);
            CHECK(std::fabs(straight_weight / kDraws - passage.transmittance.y) < 5 * sigma + 1e-6);
            for (int k = 0; k < 4; ++k)
                CHECK(std::fabs(rest[k] / kDraws - (1 - p) * stopped[k] / kDraws) < 5 * 2 / std::sqrt(static_cast<double>(kDraws)));
        }
    }
}

TEST_CASE("crossing gives the light that the surface integrator finds bounce by bounce", "[media]") {
    for (const auto& [name, material] : passing()) {
        SceneDescription d = volume_scene();
        add_shape(d, RectangleShape{}, translated({0, -1, 0}) * scaled(4) * kUp, 0);
        add_light(d, RectangleShape{}, translated({0.3, 2.5, 0}) * scaled(0.8) * kDown, Rgb(4.0f));
        d.environment = ConstantEnvironment{Rgb(0.2f), {}};
        const std::uint32_t m = add_material(d, material);
        for (int i = 0; i < 3; ++i)
            add_shape(d, RectangleShape{}, translated({0.2 * i, 0.4 * i - 0.4, 0}) * rotated({0, 0, 1}, 15.0 * i) * scaled(1.2) * kUp, m);
        look_narrowly(d, {0.5, 1.0, 4}, {0, -0.3, 0}, 35);
        const Measured crossing = measure(d, 8192);
        d.integrator.volumetric = false;
        const Measured bounces = measure(d, 32768);
        INFO(name << ": crossing " << crossing.mean << " +- " << crossing.standard_error << ", bounces " << bounces.mean << " +- "
                  << bounces.standard_error);
        CHECK(crossing.invalid + bounces.invalid == 0);
        CHECK(std::fabs(crossing.mean - bounces.mean) <= std::hypot(crossing.noise(), bounces.noise()));
        CHECK(std::max(crossing.standard_error, bounces.standard_error) < 0.01 * crossing.mean);
    }
}

TEST_CASE("a path leaves a surface in a plane through the camera", "[media]") {
    // There all coordinates across the plane are exactly 0, and so is their error.
    SceneDescription d = volume_scene();
    d.environment = ConstantEnvironment{Rgb(1.0f), {}};
    const std::uint32_t nothing = add_material(d, Null{});
    d.camera.to_world = look_at({0, 0.8, -4}, {0, 0, 0});
    d.camera.fov_x_degrees = 40;
    add_shape(d, CubeShape{}, translated({0.5, 0.5, -2}) * scaled(0.5), nothing);
    add_shape(d, RectangleShape{}, translated({0, -1, 0}) * scaled(4) * kUp, 0);
    for (int r = 0; r < 4; ++r) CHECK(Ready(d).render("random", 256, static_cast<std::uint64_t>(r)).stats.invalid_samples == 0);
}
