// Meshes that are simpler than they look: two triangles that make a parallelogram are sampled as one, normals that are the triangles'
// own are not interpolated.

#include "many_lights.h"

#include <koksma/scene/light_sampling.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();
using Indices = std::array<std::uint32_t, 3>;

/// A light of two triangles over the corners a, b, c, d, in the plane z = 2, each with its own vertices.
Scene quad_light(const std::array<glm::vec2, 4>& corners, Indices first, Indices second, bool own_vertices) {
    std::vector<glm::vec3> positions;
    std::vector<Indices> triangles{first, second};
    for (const glm::vec2& c : corners) positions.push_back({c, 2.0f});
    if (own_vertices) {
        std::vector<glm::vec3> each;
        for (Indices& t : triangles)
            for (std::uint32_t& v : t) each.push_back(positions[v]), v = static_cast<std::uint32_t>(each.size() - 1);
        positions = each;
    }
    SceneDescription d = empty_scene();
    add_light(d, mesh(positions, triangles), Matrix(1.0), Rgb(1.0f));
    return compile(d);
}

constexpr std::array<glm::vec2, 4> kLeaning{{{-1.0f, -0.5f}, {1.0f, -0.25f}, {1.5f, 0.75f}, {-0.5f, 0.5f}}};

Indices turned(Indices t, int by) {
    std::rotate(t.begin(), t.begin() + by, t.end());
    return t;
}

/// A mesh of one triangle whose normals lean by `lean` from its own, times `side`.
Scene leaning_triangle(float lean, float side) {
    SceneDescription d = empty_scene();
    const glm::vec3 n = side * glm::normalize(glm::vec3(lean, 0.0f, 1.0f)), other(0.0f, 0.0f, side);
    add_light(d, mesh({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, {{0, 1, 2}}, {n, other, other}), Matrix(1.0), Rgb(1.0f));
    return compile(d);
}

}  // namespace

TEST_CASE("two triangles that make a parallelogram are sampled without a seam, whatever vertex they begin with", "[lights]") {
    const Vec3f p{0.1f, 0.2f, 4.0f};
    for (int i = 0; i < 9; ++i)
        for (const bool own_vertices : {false, true})
            for (const bool swapped : {false, true}) {
                const Indices abc = turned({0, 1, 2}, i % 3), acd = turned({0, 2, 3}, i / 3);
                const Scene scene = quad_light(kLeaning, swapped ? acd : abc, swapped ? abc : acd, own_vertices);
                REQUIRE(scene.lights.size() == 1);
                REQUIRE(scene.lights[0].kind == LightKind::parallelogram);
                CHECK(std::fabs(scene.lights[0].area - 1.875f) < 2e-6f);
                // The target is an affine function of the numbers: so it is where the middle of any two is the middle of theirs.
                Uniform u(1);
                for (int k = 0; k < 200; ++k) {
                    const Vec2f a = u.pair(), b = u.pair(), middle{0.5f * (a.x + b.x), 0.5f * (a.y + b.y)};
                    const auto at = [&](Vec2f x) { return sample_light<kAll>(scene, scene.lights[0], p, x); };
                    CHECK(max_component(abs((at(a).target + at(b).target) * 0.5f - at(middle).target)) < 2e-4f);  // shadow targets are drawn back
                    CHECK(at(a).pdf_w > 0.0f);
                }
            }
}

TEST_CASE("two triangles that make no parallelogram stay a mesh", "[lights]") {
    const auto kind = [](const std::array<glm::vec2, 4>& corners, Indices first, Indices second) { return quad_light(corners, first, second, false).lights[0].kind; };
    std::array<glm::vec2, 4> kite = kLeaning;
    kite[2].x += 1e-4f;
    CHECK(kind(kite, {0, 1, 2}, {0, 2, 3}) == LightKind::mesh);
    CHECK(kind(kLeaning, {0, 1, 2}, {0, 3, 2}) == LightKind::mesh);  // the two show different sides
    CHECK(kind(kLeaning, {0, 1, 2}, {0, 1, 2}) == LightKind::mesh);  // one twice
    CHECK(kind(kLeaning, {0, 1, 2}, {1, 2, 3}) == LightKind::mesh);  // they overlap
}

TEST_CASE("normals call for interpolation only where they differ from the triangles' own", "[lights]") {
    const auto interpolates = [](float lean, float side) { return leaning_triangle(lean, side).effects.has(Effect::shading_normals); };
    CHECK_FALSE(interpolates(0.0f, 1.0f));
    CHECK(interpolates(1e-5f, 1.0f));
    CHECK(interpolates(0.0f, -1.0f));  // those of the other side are the light's
}
