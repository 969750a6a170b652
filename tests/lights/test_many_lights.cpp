// Renders of scenes with many lights: one mean, whether lights are chosen by the tree or by power, and less noise by the tree.

#include "many_lights.h"

#include <scenes/pixel_variance.h>

#include <numeric>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// A floor, a wall and two boxes, one of them shiny, among n lights.
SceneDescription room(int n, std::uint32_t seed, bool sky = false) {
    SceneDescription d = empty_scene(6, 6);
    Uniform u(seed);
    add_shape(d, RectangleShape{}, translated({0, -1.01, 0}) * scaled(3) * kUp, 0);
    add_shape(d, RectangleShape{}, translated({0, 0, -1.1}) * scaled(3), 0);
    RoughConductor metal;
    metal.distribution = RoughConductor::Distribution::ggx;
    metal.alpha_u = metal.alpha_v = Rgb(0.2f);
    metal.base.perfect = true;
    const std::uint32_t shiny = add_material(d, metal), both = add_diffuse(d, 0.6f, true);
    add_shape(d, CubeShape{}, translated({-0.4, -0.7, 0.1}) * rotated({0, 1, 0}, 20) * scaled(0.3), shiny);
    add_shape(d, RectangleShape{}, translated({0.5, -0.5, 0.2}) * rotated({1, 0, 0}, -120) * scaled(0.4), both);
    add_lights(d, u, n);
    if (sky) d.environment = ConstantEnvironment{Rgb(0.05f), {}};
    d.camera.to_world = look_at({0.3, 0.8, 3.2}, {0, -0.4, 0});
    d.camera.fov_x_degrees = 50;
    d.integrator.max_depth = 4;
    return d;
}

double mean_variance(const Ready& ready, std::uint64_t spp, int replicates) {
    const std::vector<double> v = pixel_variances(ready, kSobol, spp, replicates);
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

}  // namespace

TEST_CASE("the tree and the choice by power have one mean", "[lights]") {
    for (const bool sky : {false, true}) {
        const SceneDescription d = room(200, 5, sky);
        const Ready tree(d), power = by_power(d);
        REQUIRE(tree.plan.effects.has(Effect::many_lights));
        const Measured a = measure(tree, 1024, 16), b = measure(power, 1024, 16, kSobol, 100);
        INFO("tree " << a.mean << " +- " << a.standard_error << ", power " << b.mean << " +- " << b.standard_error);
        CHECK(a.invalid == 0);
        CHECK(std::fabs(a.mean - b.mean) <= 4.5 * std::hypot(a.standard_error, b.standard_error));
        CHECK(b.standard_error <= 0.02 * b.mean);
        CHECK(a.standard_error < b.standard_error);
    }
}

TEST_CASE("the tree's noise is below that of the choice by power", "[lights]") {
    const SceneDescription d = room(200, 6);
    const double tree = mean_variance(Ready(d), 64, 16), power = mean_variance(by_power(d), 64, 16);
    INFO("variance by power / by tree: " << power / tree);
    CHECK(power / tree > 2.0);
}

TEST_CASE("a furnace of many shining triangles shows Le / (1 - albedo)", "[lights]") {
    // A cube of 6 x 8 x 8 squares: 768 triangles of one light.
    std::vector<glm::vec3> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int face = 0; face < 6; ++face)
        for (int k = 0; k < 64; ++k) {
            const auto first = static_cast<std::uint32_t>(corners.size());
            for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                const float a = static_cast<float>(k % 8 + dx) / 4 - 1, b = static_cast<float>(k / 8 + dy) / 4 - 1, s = face % 2 == 0 ? 1.0f : -1.0f;
                corners.push_back(face < 2 ? glm::vec3(a * s, b, s) : face < 4 ? glm::vec3(s, a * s, b) : glm::vec3(b, s, a * s));
            }
            triangles.push_back({first, first + 1, first + 2});
            triangles.push_back({first, first + 2, first + 3});
        }
    const Ready ready(furnace(mesh(corners, triangles), Matrix(1.0), 0.5f, 1.0f));
    REQUIRE(ready.plan.effects.has(Effect::many_lights));
    check_mean(measure(ready, 1024, 8), 2.0, 1e-3);
}

TEST_CASE("few lights keep the choice by power", "[lights]") {
    for (const int n : {1, 2, 6}) {
        const Ready ready(room(n, 9));
        CHECK(ready.plan.effects.has(Effect::many_lights) == (n == 6));
        CHECK(ready.scene.light_tree.empty() == (n < 6));  // the fourth is 4 triangles, the fifth 12
    }
}
