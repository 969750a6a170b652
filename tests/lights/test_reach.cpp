// No light that can contribute to a point has probability zero there: lights are sampled, and where a sample would add light,
// the tree has to have a way to it.

#include "many_lights.h"

#include <koksma/scene/light_sampling.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();

/// Samples every light at each place. @return  how many samples contributed
int check_reach(const Scene& scene, const std::vector<Place>& at, Uniform& u) {
    int contributing = 0;
    for (const Place& place : at)
        for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
            const Light& light = scene.lights[i];
            const auto parts = light.kind == LightKind::mesh ? static_cast<std::uint32_t>(light.triangles.size()) : 1u;
            for (std::uint32_t t = 0; t < parts; ++t) {
                const std::uint32_t triangle = light.kind == LightKind::mesh ? t : kWholeLight;
                float probability = -1.0f;
                for (int k = 0; k < 6; ++k) {
                    const LightSample s = sample_light<kAll>(scene, light, place.p, u.pair(), triangle);
                    if (!(s.pdf_w > 0.0f && dot(place.n, s.wi) > 0.0f && luminance(s.radiance) > 0.0f)) continue;
                    if (s.pdf_w > 1e37f) continue;  // 1 / pdf is no float
                    ++contributing;
                    if (probability < 0.0f) probability = scene.light_tree.probability(i, triangle, place.p, place.n);
                    if (!(probability > 0.0f)) {
                        FAIL_CHECK("light " << i << " of kind " << static_cast<int>(light.kind) << " triangle " << t << " at (" << place.p.x << ", " << place.p.y
                                            << ", " << place.p.z << "), normal (" << place.n.x << ", " << place.n.y << ", " << place.n.z
                                            << "): cosine " << dot(place.n, s.wi) << ", probability " << probability);
                        return contributing;
                    }
                }
            }
        }
    return contributing;
}

}  // namespace

TEST_CASE("whatever light can reach a point has a probability there", "[lights]") {
    int contributing = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed)
        for (const double size : {1.0, 1e-6, 1e4}) {
            Uniform u(seed);
            SceneDescription d = empty_scene();
            add_lights(d, u, seed % 3 == 0 ? 12 : 60, seed % 2 == 0 ? 0.03 : 0.4);
            for (Shape& s : d.shapes) s.to_world = scaled(size) * s.to_world;
            for (PointLight& p : d.point_lights) p.position *= size;
            const Scene scene = compile(d);
            REQUIRE(scene.effects.has(Effect::many_lights));
            const auto f = static_cast<float>(size);
            std::vector<Place> at;
            for (int i = 0; i < 60; ++i) {
                at.push_back({random_in_cube(u) * f, random_unit(u)});
                at.push_back({random_unit(u) * (f * std::pow(10.0f, 6.0f * u())), random_unit(u)});
                // On a light, and a hair above it.
                const Light& light = scene.lights[static_cast<std::size_t>(u() * static_cast<float>(scene.lights.size()))];
                if (light.kind == LightKind::sphere || light.kind == LightKind::point || light.kind == LightKind::disk) continue;
                const Surface s = triangle_surface<EffectSet::all()>(scene, light.geometry, scene.geometries[light.geometry].first, {0.3f * u(), 0.3f * u()});
                at.push_back({s.p, s.ng});
                at.push_back({s.p, random_unit(u)});
                at.push_back({s.p + s.ng * (1e-5f * f), random_unit(u)});
            }
            contributing += check_reach(scene, at, u);
        }
    INFO(contributing << " samples contribute");
    CHECK(contributing > 1000000);
}

TEST_CASE("lights in a plane reach what lies just off the plane, and nothing behind it", "[lights]") {
    SceneDescription d = empty_scene();
    for (int i = 0; i < 100; ++i) add_light(d, RectangleShape{}, translated({i % 10 - 4.5, 3.0, i / 10 - 4.5}) * scaled(0.01) * kDown, Rgb(1.0f));
    const Scene scene = compile(d);
    Uniform u(2);
    std::vector<Place> at;
    for (const float below : {0.0f, 1e-6f, 1e-5f, 1e-4f, 1e-3f, 1e-2f})
        for (int i = 0; i < 30; ++i) at.push_back({Vec3f{8 * u() - 4, 3.0f - below, 8 * u() - 4}, random_unit(u)});
    CHECK(check_reach(scene, at, u) > 10000);
    for (const Place& place : at) {
        double sum = 0;
        for (std::uint32_t i = 0; i < 100; ++i) sum += scene.light_tree.probability(i, kWholeLight, place.p + Vec3f{0, 1.1f, 0}, place.n);
        CHECK(sum == 0.0);
    }
}

TEST_CASE("a black light and a triangle without area are never chosen", "[lights]") {
    SceneDescription d = empty_scene();
    Uniform u(3);
    add_lights(d, u, 40);
    add_light(d, RectangleShape{}, Matrix(1.0), Rgb(0.0f));
    const auto black = static_cast<std::uint32_t>(d.shapes.size() - 1);
    add_light(d, mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 1}, {0, 1, 2}}), Matrix(1.0), Rgb(1.0f));
    const Scene scene = compile(d);
    const auto light_of = [&](std::size_t shape) { return static_cast<std::uint32_t>(scene.geometries[shape].light); };
    for (int i = 0; i < 1000; ++i) {
        const Vec3f p = random_in_cube(u), n = random_unit(u);
        CHECK(scene.light_tree.probability(light_of(black), kWholeLight, p, n) == 0.0f);
        CHECK(scene.light_tree.probability(light_of(black + 1), 0, p, n) == 0.0f);
        const LightChoice c = scene.light_tree.choose(p, n, u());
        CHECK((c.probability == 0.0f || c.light != light_of(black)));
    }
    CHECK(scene.light_tree.probability(light_of(black + 1), 1, {0, 0, 1}, {0, 0, -1}) > 0.0f);
}
