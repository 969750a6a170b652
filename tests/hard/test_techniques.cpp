// Rows that are easy for light sampling alone and for BSDF sampling alone, and wrong with both where their densities disagree.

#include <scenes/render_scene.h>

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// All three estimates, each against the closed form.
void check_three_ways(SceneDescription d, std::uint64_t spp, double expected, double tolerance) {
    for (const Technique t : {Technique::light, Technique::bsdf, Technique::mis}) {
        d.integrator.technique = t;
        INFO("technique " << static_cast<int>(t));
        check_mean(measure(d, spp, 8), expected, tolerance);
    }
}

}  // namespace

TEST_CASE("A9: a sphere that is lit by itself shows 2 three ways", "[hard]") {
    for (const double o : {0.0, 3.0, 300.0}) {
        SceneDescription d = furnace(SphereShape{}, translated(glm::dvec3(o)), 0.5f, 1.0f);
        d.camera.to_world = translated({o + 0.1, o, o});
        INFO("centre " << o);
        check_three_ways(d, 1024, 2.0, 4e-3);
    }
}

TEST_CASE("B1: a tiny furnace shows 2 three ways", "[hard]") {
    for (const double radius : {1e-4, 1e-8}) {
        SceneDescription d = furnace(CubeShape{}, scaled(radius), 0.5f, 1.0f);
        d.camera.near_clip = 1e-3 * radius;
        d.camera.to_world = translated(glm::dvec3(0.1, -0.2, 0.05) * radius);
        INFO("radius " << radius);
        check_three_ways(d, 1024, 2.0, 1e-2);
    }
}

TEST_CASE("B3: a furnace far from the world's origin shows 2 three ways", "[hard]") {
    for (const double offset : {1e4, 1e6}) {
        SceneDescription d = furnace(CubeShape{}, translated(glm::dvec3(offset)), 0.5f, 1.0f);
        d.camera.to_world = translated(glm::dvec3(offset) + glm::dvec3(0.1, -0.2, 0.05));
        INFO("offset " << offset);
        check_three_ways(d, 1024, 2.0, 1e-2);
    }
}

TEST_CASE("D1: a sphere of 1 sr lights the floor alike three ways", "[hard]") {
    SceneDescription d = empty_scene();
    add_shape(d, RectangleShape{}, scaled(1e3) * kUp, 0);
    look_narrowly(d, {0, 1, 1}, {0, 0, 0});
    const double omega = 1.0;
    add_light(d, SphereShape{}, translated({0, 5, 0}) * scaled(5 * std::sqrt(omega / std::numbers::pi)), Rgb(static_cast<float>(std::numbers::pi / omega)));
    check_three_ways(d, 1 << 16, 0.5, 2e-3);
}
