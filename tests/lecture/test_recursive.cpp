// The recursive estimator is the reference kernel's, path by path; its strategies are estimates of one picture.

#include "estimates.h"

#include <kernels/traced.h>
#include <samplers/refusal.h>

using namespace koksma;
using namespace koksma::testing;
using koksma::test::contains;
using koksma::test::refusal;

TEST_CASE("the recursive estimator gives what the reference kernel gives, path by path", "[lecture]") {
    int compared = 0;
    for (const NamedScene& s : kernel_scenes()) {
        INFO(s.name);
        const Ready ready(s.description);
        if (!kLectureEffects.contains(ready.plan.effects)) {
            CHECK(contains(refusal([&] { static_cast<void>(make_plan(ready.scene, s.description.integrator, EstimatorSettings{})); }), "do not know"));
            continue;
        }
        ++compared;
        const Traced reference = trace_all(ready, find_kernel("reference/all", ready.plan.effects), 4, 7);
        const auto source = samplers().make(kSobol)->bind(sampling_plan(ready.scene, ready.plan, 4, 7));
        RecursiveEstimator estimator(ready.scene, ready.plan, *source, {});
        const FlushDenormals flush;
        const PixelRect rect = crop_of(ready.scene.film);
        std::size_t at = 0, differ = 0;
        for (std::int32_t y = rect.y; y < rect.y + rect.height; ++y)
            for (std::int32_t x = rect.x; x < rect.x + rect.width; ++x)
                for (std::uint64_t i = 0; i < 4; ++i, ++at) {
                    const Vec3f a = estimator.sample({{x, y}, i}).total(), b = reference.radiance[at];
                    // Products in another order: rounding, and once in a while another outcome of roulette.
                    const auto near = [](float p, float q) {
                        return std::fabs(p - q) <= 1e-4f * std::max(std::fabs(p), std::fabs(q)) + 1e-6f;
                    };
                    differ += near(a.x, b.x) && near(a.y, b.y) && near(a.z, b.z) ? 0 : 1;
                }
        INFO(differ << " of " << at << " differ");
        CHECK(differ * 10000 <= at);
        const RayCounts rays = estimator.ledger().rays;
        CHECK(rays.closest <= reference.rays.closest + at / 1000);
        CHECK(reference.rays.closest <= rays.closest + at / 1000);
    }
    CHECK(compared >= 25);
}

TEST_CASE("light met, sampled or both is the same light, whether directions come from the BSDF or are uniform",
          "[lecture]") {
    SceneDescription d = floor_scene();
    const std::uint32_t rough = add_material(d, RoughConductor{});
    add_shape(d, SphereShape{}, translated({0.4, 0.35, 0.3}) * scaled(0.35), rough);
    const double expected = measure(Ready(d), 4096, 8).mean;
    for (const Technique light : {Technique::bsdf, Technique::light, Technique::mis})
        for (const DirectionStrategy direction : {DirectionStrategy::bsdf, DirectionStrategy::uniform}) {
            INFO(name(light) << ", " << name(direction));
            EstimatorSettings s = with(light);
            s.direction = direction;
            check_mean(measure(Estimator(d, s), 2048, 16), expected, 0.02);
        }
}

TEST_CASE("the terms add up to the picture, and are those of the furnace's series", "[lecture]") {
    const Estimator e(empty_furnace(0.5f, -1, 8), with(Technique::bsdf, "throughput"));
    const EstimateResult r = e.render("random", 1024, 3, true);
    REQUIRE(r.terms.size() == NeumannSeries::kTerms);
    double sum = 0;
    for (std::size_t k = 0; k < r.terms.size(); ++k) {
        const double mean = r.terms[k].mean().y, rest = k + 1 == r.terms.size() ? 2.0 : 1.0;
        INFO("term " << k << ": " << mean);
        CHECK(std::fabs(mean - rest * std::pow(0.5, k)) < 0.01);  // survivors of k games are binomial: the sd of term 1 is 0.002
        sum += mean;
    }
    CHECK(std::fabs(sum - r.film.mean().y) < 1e-5);
}

TEST_CASE("a recursive render has the same bytes for any number of threads", "[lecture]") {
    SceneDescription d = floor_scene();
    for (const std::uint32_t branching : {1u, 2u}) {
        const Estimator e(d, with(Technique::mis, "constant=0.7", branching));
        const EstimateResult one = e.render(kSobol, 16, 1, true, 1), many = e.render(kSobol, 16, 1, true, 5);
        CHECK(same_bytes(one.film, many.film));
        for (std::size_t k = 0; k < one.terms.size(); ++k) CHECK(same_bytes(one.terms[k], many.terms[k]));
        CHECK(one.ledger.rays.closest == many.ledger.rays.closest);
        CHECK(one.ledger.roulette.excess == many.ledger.roulette.excess);
    }
}

TEST_CASE("settings that mean nothing are refused", "[lecture]") {
    const Scene scene = compile(floor_scene());
    IntegratorSettings endless;
    const auto refused = [&](const EstimatorSettings& s, const char* why) {
        const std::string message = refusal([&] { static_cast<void>(make_plan(scene, endless, s)); });
        INFO(message);
        CHECK(contains(message, why));
    };
    refused(with(Technique::mis, "none"), "never end");
    refused(with(Technique::mis, "depth=2.5"), "whole number");
    refused(with(Technique::mis, "constant=0"), "survival in (0, 1]");
    refused(with(Technique::mis, "threshold=0"), "above 0");
    refused(with(Technique::mis, "throughput", 2), "no end");
    EstimatorSettings s;
    CHECK(contains(refusal([&] { set_end(s, "depth"); }), "expected a value"));
    CHECK(contains(refusal([&] { set_end(s, "throughput=1"); }), "no value"));
    CHECK(contains(refusal([&] { set_end(s, "constant=half"); }), "not a number"));
    CHECK(contains(refusal([&] { set_end(s, "luck"); }), "expected none, depth"));
    CHECK(contains(refusal([&] { static_cast<void>(technique_of("nee")); }), "mis, light, bsdf"));
    SceneDescription with_point = floor_scene();
    with_point.point_lights.push_back({{0, 1, 0}, Rgb(1.0f), {}});
    CHECK(contains(refusal([&] { static_cast<void>(make_plan(compile(with_point), endless, with(Technique::bsdf))); }),
                   "without extent"));
    const Estimator deep(
        [&] {
            SceneDescription d = floor_scene();
            d.integrator.max_depth = 20;
            return d;
        }(),
        with(Technique::mis, "none", 8));
    CHECK(contains(refusal([&] { static_cast<void>(deep.render(kSobol, 1, 0)); }), "2^32"));
}
