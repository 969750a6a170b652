// Adaptive sampling: counts are those asked for, two stages have no bias, one stage has the bias that is known.

#include "estimates.h"

#include <effects/effect_scenes.h>
#include <samplers/refusal.h>

#include <koksma/integrators/lecture/adaptive.h>

#include <algorithm>
#include <numeric>

using namespace koksma;
using namespace koksma::testing;
using koksma::test::contains;
using koksma::test::refusal;

TEST_CASE("equal counts give the bytes of an ordinary render, others its prefixes", "[lecture]") {
    SceneDescription d = floor_scene();
    const Ready ready(d);
    const PixelRect rect = crop_of(ready.scene.film);
    const auto source = samplers().make(kSobol)->bind(sampling_plan(ready.scene, ready.plan, 128, 5));
    const Film all = ready.render(kSobol, 128, 5).film;
    const Film few = ready.render(kSobol, 128, 5, {rect, 0, 16}).film;
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(rect.area()), 128);
    CHECK(same_bytes(render_counts(ready.scene, ready.plan, *source, rect, counts, 1).film, all));
    for (std::size_t p = 0; p < counts.size(); ++p) counts[p] = p % 3 == 0 ? 16 : p % 3 == 1 ? 128 : 0;
    const Film mixed = render_counts(ready.scene, ready.plan, *source, rect, counts, 2).film;
    for (std::size_t p = 0; p < counts.size(); ++p) {
        const Pixel pixel{static_cast<std::int32_t>(p) % rect.width, static_cast<std::int32_t>(p) / rect.width};
        CHECK(mixed.count(pixel) == counts[p]);
        CHECK(mixed.mean(pixel) == (p % 3 == 0 ? few.mean(pixel) : p % 3 == 1 ? all.mean(pixel) : Vec3d{}));
    }
}

TEST_CASE("counts follow the noise within the budget", "[lecture]") {
    const std::vector<std::uint64_t> allowed{4, 8, 16, 32, 64, 128};
    std::vector<double> noise;
    for (int i = 0; i < 1000; ++i) noise.push_back(std::pow(10.0, -2.0 * i / 1000));
    const std::vector<std::uint64_t> counts = allocate(noise, allowed, 40);
    const double mean = static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0})) / 1000;
    CHECK(mean <= 40);
    CHECK(mean > 39.5);
    CHECK(std::is_sorted(counts.rbegin(), counts.rend()));
    CHECK(counts.front() == 128);
    CHECK(counts.back() == 4);
    CHECK(allocate({0, 0}, allowed, 40) == std::vector<std::uint64_t>{32, 32});
    CHECK(allocate({1, 1}, allowed, 1000) == std::vector<std::uint64_t>{128, 128});
    CHECK(allocate({0, 1}, allowed, 66) == std::vector<std::uint64_t>{4, 128});
}

namespace {

/// A small lamp far away, that few directions find: dark, calm pilots are common.
SceneDescription rare_light() {
    SceneDescription d = empty_scene(8, 8);
    add_shape(d, RectangleShape{}, scaled(3) * kUp, 0);
    const std::uint32_t mirror = add_material(d, Conductor{});
    add_shape(d, SphereShape{}, translated({0.4, 0.5, 0.2}) * scaled(0.5), mirror);
    add_light(d, SphereShape{}, translated({-2, 3, 1}) * scaled(0.5), Rgb(20.0f));
    d.camera.to_world = look_at({0.3, 1.2, 2.5}, {0, 0.3, 0});
    d.integrator.max_depth = 4;
    return d;
}

Measured adaptive(const Ready& ready, AdaptiveMode mode, int replicates) {
    std::vector<double> means;
    AdaptiveSettings s;
    s.mode = mode;
    s.average_spp = 24;
    s.most_spp = 256;
    for (int r = 0; r < replicates; ++r) {
        s.seed = static_cast<std::uint64_t>(r);
        const AdaptiveResult result = render_adaptive(ready.scene, ready.plan, *samplers().make("random"), crop_of(ready.scene.film), s);
        if (result.spent_spp > 24) FAIL("spent " << result.spent_spp);
        means.push_back(result.film.mean().y);
    }
    return measured(means);
}

}  // namespace

TEST_CASE("two stages have no bias, one stage has one, downwards", "[lecture]") {
    const Ready ready(rare_light());
    const double truth = measure(ready, 4096, 16).mean;
    const Measured two = adaptive(ready, AdaptiveMode::two_stage, 1200), one = adaptive(ready, AdaptiveMode::one_stage, 1200);
    INFO("truth " << truth << ", two stages " << two.mean << " +- " << two.standard_error << ", one stage " << one.mean << " +- "
                  << one.standard_error);
    check_noise(two, truth, 0.01);
    CHECK(one.mean < truth - 4 * one.standard_error);
}

TEST_CASE("adaptive sampling refuses what it cannot do", "[lecture]") {
    const Ready ready(floor_scene());
    const auto tried = [&](const char* sampler, AdaptiveSettings s) {
        return refusal(
            [&] { static_cast<void>(render_adaptive(ready.scene, ready.plan, *samplers().make(sampler), crop_of(ready.scene.film), s)); });
    };
    CHECK(contains(tried("stratified", {}), "needs a sequence"));
    CHECK(contains(tried("sobol:randomize=none", {}), "fresh scrambles"));
    AdaptiveSettings s;
    s.average_spp = 18;
    CHECK(contains(tried(kSobol, s), "leaves 2"));
    s = {};
    s.pilot_scrambles = 1;
    CHECK(contains(tried(kSobol, s), "two scrambles"));
}
