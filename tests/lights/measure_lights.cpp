// The figures that docs/design.md and compile_lights.cpp give for the light tree. Not run by CTest:
//     build/release/bin/test_lights "[measure]"

#include "many_lights.h"

#include <scenes/pixel_variance.h>

#include <koksma/scene/light_sampling.h>
#include <koksma/scene/load.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

using namespace koksma;
using namespace koksma::testing;

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Cost {
    double variance = 0, median = 0, seconds = 0;  ///< mean and median over the pixels; of one render
};

Cost cost_of(const Ready& ready, const char* sampler, std::uint64_t spp, int replicates) {
    const double start = seconds();
    std::vector<double> v = pixel_variances(ready, sampler, spp, replicates);
    Cost out;
    out.seconds = (seconds() - start) / replicates;
    for (const double x : v) out.variance += x / static_cast<double>(v.size());
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    out.median = v[v.size() / 2];
    return out;
}

void compare(const char* name, SceneDescription d, const char* sampler, std::uint64_t spp, int replicates) {
    // Lamps that the camera sees have the same noise either way, at their edges, and drown all other.
    d.integrator.hide_emitters = true;
    const Cost tree = cost_of(Ready(d), sampler, spp, replicates), power = cost_of(by_power(d), sampler, spp, replicates);
    std::printf("%-28s %-24s %3d spp: variance by power / by tree: mean %7.2f median %7.2f   time by tree / by power %5.2f (%.3f s)\n", name, sampler,
                static_cast<int>(spp), power.variance / tree.variance, power.median / tree.median, tree.seconds / power.seconds, tree.seconds);
}

/// n equal lamps in a ceiling of 6 m x 6 m.
SceneDescription ceiling(int n) {
    SceneDescription d = empty_scene(24, 24);
    add_shape(d, RectangleShape{}, scaled(3) * kUp, 0);
    add_shape(d, CubeShape{}, translated({0.5, 0.5, 0}) * scaled(0.5), 0);
    Uniform u(1);
    for (int i = 0; i < n; ++i) add_light(d, RectangleShape{}, translated({6 * u() - 3, 2.5, 6 * u() - 3}) * scaled(0.1) * kDown, Rgb(10.0f));
    d.camera.to_world = look_at({0.3, 2.0, 5}, {0, 0.5, 0});
    d.camera.fov_x_degrees = 50;
    d.integrator.max_depth = 3;
    return d;
}

}  // namespace

TEST_CASE("what a choice costs", "[.][measure]") {
    for (const std::uint32_t n : {10u, 100u, 1000u, 10000u, 100000u}) {
        const std::vector<LightLeaf> leaves = random_leaves(Crowd::triangles, n, 8);
        double start = seconds();
        const LightTree tree = build_light_tree(leaves, n);
        const double build = seconds() - start;
        constexpr int kChoices = 1 << 17;
        Uniform u(2);
        std::vector<Place> at;
        std::vector<float> numbers;
        std::vector<std::uint32_t> chosen;
        double none = 0;
        for (int i = 0; i < kChoices; ++i) {
            at.push_back({random_in_cube(u), random_unit(u)});
            numbers.push_back(u());
        }
        start = seconds();
        for (int i = 0; i < kChoices; ++i) {
            const LightChoice c = tree.choose(at[static_cast<std::size_t>(i)].p, at[static_cast<std::size_t>(i)].n, numbers[static_cast<std::size_t>(i)]);
            none += c.probability > 0 ? 0 : 1;
            chosen.push_back(c.light);
        }
        const double choose = (seconds() - start) / kChoices;
        start = seconds();
        float sum = 0;
        for (int i = 0; i < kChoices; ++i)
            sum += tree.probability(chosen[static_cast<std::size_t>(i)], kWholeLight, at[static_cast<std::size_t>(i)].p, at[static_cast<std::size_t>(i)].n);
        const double probability = (seconds() - start) / kChoices;
        std::printf("%6u lights: choose %6.0f ns, probability %6.0f ns, build %8.3f ms, none %.3f (%g)\n", n, 1e9 * choose, 1e9 * probability, 1e3 * build,
                    none / kChoices, static_cast<double>(sum > 0));
    }
}

TEST_CASE("what a choice is worth", "[.][measure]") {
    const std::filesystem::path file = std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/many-lights.xml";
    for (const char* sampler : {"random", kSobol}) compare("many-lights", load_scene(file, {{"res", "48"}}), sampler, 16, 16);
}

TEST_CASE("from how many lights on a tree is worth its time", "[.][measure]") {
    for (const char* sampler : {"random", kSobol})
        for (const int n : {3, 6, 11, 16, 23, 32, 47, 64, 97, 200, 1000})
            compare(("ceiling of " + std::to_string(n)).c_str(), ceiling(n), sampler, 64, 8);
}

TEST_CASE("how well a choice follows the light that arrives", "[.][measure]") {
    constexpr EffectSet kAll = EffectSet::all();
    const std::filesystem::path file = std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/many-lights.xml";
    for (const bool built_in : {true, false}) {
        const Ready ready(built_in ? load_scene(file, {{"res", "48"}}) : ceiling(1000));
        const Scene& scene = ready.scene;
        Uniform u(1);
        double power = 0, tree = 0;
        int n = 0;
        for (int i = 0; i < 1000; ++i) {
            const Pixel pixel{static_cast<std::int32_t>(u() * static_cast<float>(scene.film.width)), static_cast<std::int32_t>(u() * static_cast<float>(scene.film.height))};
            const Vec2f film = u.pair(), lens = u.pair();
            const auto c = camera_ray<float>(scene.camera, film_point(scene.camera, pixel.x, pixel.y, film), lens);
            const Ray ray{c.o, c.d, c.t_near, c.t_far};
            const Hit hit = scene.accelerator.intersect(ray);
            if (!hit.valid()) continue;
            const Surface s = surface_at<kAll>(scene, ray, hit);
            const Vec3f normal = dot(s.ng, ray.d) < 0 ? s.ng : -s.ng;
            // Irradiance of each light from its middle, nothing in between; and its square over the probability.
            double sum = 0, by_tree = 0, by_power = 0;
            for (const LightTree::LeafId leaf : scene.light_tree.leaves) {
                const Light& light = scene.lights[leaf.light];
                const LightSample l = sample_light<kAll>(scene, light, s.p, {0.5f, 0.5f}, leaf.triangle);
                if (!(l.pdf_w > 0 && dot(l.wi, normal) > 0)) continue;
                const double e = double{dot(l.wi, normal)} * luminance(l.radiance) / l.pdf_w;
                sum += e;
                by_tree += e * e / scene.light_tree.probability(leaf.light, leaf.triangle, s.p, normal);
                by_power += e * e / (double{scene.light_choice.probability(leaf.light)} * light.area_of(leaf.triangle) / light.area);
            }
            if (!(sum > 0)) continue;
            tree += by_tree / (sum * sum) - 1;
            power += by_power / (sum * sum) - 1;
            ++n;
        }
        std::printf("%-20s relative variance of one choice, mean of %d points: by power %.3f, by tree %.3f\n", built_in ? "many-lights" : "ceiling of 1000", n, power / n,
                    tree / n);
    }
}
