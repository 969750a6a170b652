// The furnace shows Le / (1 - albedo), whatever stands in it, whatever samples it.

#include "render_scene.h"

#include <koksma/scene/load.h>

#include <filesystem>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("an empty furnace of albedo 0.5 shows 2 to a thousandth with every sampler", "[scenes]") {
    const Ready ready(furnace(CubeShape{}, Matrix(1.0), 0.5f, 1.0f));
    for (const char* sampler : {"random", "stratified", "halton", kSobol, "sobol:randomize=xor"}) {
        INFO(sampler);
        check_mean(measure(ready, 1024, 8, sampler), 2.0, 1e-3);
    }
}

TEST_CASE("a shining ball in a shining furnace vanishes", "[scenes]") {
    // Two lights of different kinds, light choice, and occlusion both ways.
    for (const bool glossy : {false, true}) {
        SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.5f, 1.0f);
        const std::uint32_t half = add_diffuse(d, 0.5f);
        add_shape(d, SphereShape{}, translated({0.2, 0.1, 0.3}) * scaled(0.4), half).emission = AreaEmission{Rgb(1.0f), {}};
        if (glossy) {  // a mirror without emission sees 2 and shows 2
            const std::uint32_t mirror = add_material(d, Conductor{});
            add_shape(d, SphereShape{}, translated({-0.5, 0.1, 0.5}) * scaled(0.2), mirror);
        }
        d.camera.to_world = look_at({-0.3, 0.2, -0.9}, {0, 0, 1});
        for (const char* sampler : {"random", kSobol}) {
            INFO(sampler << (glossy ? " with a mirror" : ""));
            check_mean(measure(d, 2048, 8, sampler), 2.0, 1e-3);
        }
    }
}

TEST_CASE("a furnace with every kind of surface light shows 2", "[scenes]") {
    SceneDescription d = furnace(CubeShape{}, scaled(2), 0.5f, 1.0f);
    const std::uint32_t half = add_diffuse(d, 0.5f, true);
    const auto both_sides = [&](Geometry geometry, const Matrix& at) {
        add_shape(d, geometry, at, half).emission = AreaEmission{Rgb(1.0f), {}};
        Shape& back = add_shape(d, geometry, translated({0, 0.001, 0}) * at, half);
        back.flip_normals = true;
        back.emission = AreaEmission{Rgb(1.0f), {}};
    };
    both_sides(RectangleShape{}, translated({1, -1, 0.5}) * scaled(0.5) * kDown);
    both_sides(DiskShape{}, translated({-1, -0.5, 0.5}) * scaled(0.6) * kDown);
    both_sides(mesh({{-0.5f, 0, 1}, {0.5f, 0, 1}, {0, 0, 1.8f}, {-0.5f, 0, 1.8f}}, {{0, 1, 2}, {0, 2, 3}}), translated({0, 0.7, 0}));
    add_shape(d, SphereShape{}, translated({0.2, -0.1, 1.2}) * scaled(0.3), half).emission = AreaEmission{Rgb(1.0f), {}};
    d.camera.to_world = look_at({-0.3, 0.1, -1.5}, {0, 0, 1});
    check_mean(measure(d, 2048, 8, kSobol), 2.0, 2e-3);
}

TEST_CASE("the built-in furnace shows 1 / (1 - albedo), and its series with max_depth", "[scenes]") {
    const std::filesystem::path file = std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/furnace.xml";
    check_mean(measure(load_scene(file, {{"res", "4"}}), 1024, 8), 2.0, 1e-3);
    check_mean(measure(load_scene(file, {{"res", "4"}, {"albedo", "0.8"}}), 2048, 8), 5.0, 3e-3);
    for (const int n : {1, 2, 3, 6, 11}) {
        INFO("max_depth " << n);
        check_mean(measure(load_scene(file, {{"res", "4"}, {"max_depth", std::to_string(n)}}), 1024, 8), 2.0 * (1.0 - std::pow(0.5, n)), 1e-3);
    }
}

TEST_CASE("roulette changes no mean", "[scenes]") {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.5f, 1.0f);
    for (const int rr_depth : {0, 1, 2, 5, 20}) {
        d.integrator.rr_depth = rr_depth;
        INFO("rr_depth " << rr_depth);
        check_mean(measure(d, 1024, 8), 2.0, 2e-3);
    }
}

TEST_CASE("paths beyond the laid-out bounces draw from the tail and keep the mean", "[scenes]") {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.98f, 0.02f);
    const Ready ready(d);
    CHECK(ready.render(kSobol, 16, 1).stats.tail_numbers > 0);
    check_mean(measure(ready, 256, 8, "random"), 1.0, 2e-2);
    check_mean(measure(ready, 256, 8, kSobol), 1.0, 2e-2);
}

TEST_CASE("hidden emitters are black to the camera and light the rest", "[scenes]") {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.5f, 1.0f);
    d.integrator.hide_emitters = true;
    check_mean(measure(d, 1024, 8), 1.0, 1e-3);
}
