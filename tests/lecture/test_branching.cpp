// Branching: the same picture, and the variance that the levels of the tree leave.

#include "estimates.h"

#include <effects/effect_scenes.h>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("branching changes no expectation, with random and with Sobol'", "[lecture]") {
    SceneDescription d = floor_scene();
    d.integrator.max_depth = 3;
    const double expected = measure(Ready(d), 4096, 8).mean;
    for (const char* sampler : {"random", kSobol})
        for (const std::uint32_t branching : {2u, 3u, 8u}) {
            INFO(sampler << ", " << branching);
            check_mean(measure(Estimator(d, with(Technique::mis, "none", branching)), 64, 16, sampler), expected, 0.01);
        }
}

TEST_CASE("a full tree has B^k rays on level k, and weights that add up", "[lecture]") {
    const int depth = 4;
    for (const std::uint32_t branching : {1u, 2u, 3u}) {
        const EstimateResult r =
            Estimator(empty_furnace(0.5f, depth, 4), with(Technique::bsdf, "none", branching)).render("random", 4, 1);
        std::uint64_t rays = 0, level = r.ledger.samples;
        for (int k = 0; k < depth; ++k, level *= branching) rays += level;
        CHECK(r.ledger.rays.closest == rays);
        CHECK(std::fabs(r.ledger.truncated.weight / double(r.ledger.samples) - 0.125) < 1e-9);
        CHECK(std::fabs(r.film.mean().y - 1.875) < 1e-6);
    }
}

// With one bounce, the variance of a sample is that of the camera's numbers plus that of the bounce over B: two unknowns, from B = 1 and B
// = 2; the other factors must follow.
TEST_CASE("the variance of a bounce falls as one over the branching factor", "[lecture]") {
    SceneDescription d = floor_scene();
    d.integrator.max_depth = 2;
    d.film.width = d.film.height = 16;
    const std::vector<float> truth = Estimator(d, with(Technique::mis, "none")).render(kSobol, 1 << 14, 99).film.image();
    const auto variance = [&](std::uint32_t branching) {
        const Estimator e(d, with(Technique::bsdf, "none", branching));
        std::vector<double> values;
        for (std::uint64_t r = 1; r <= 64; ++r) {
            const std::vector<float> image = e.render("random", 16, r * 100 + branching).film.image();
            double sum = 0;
            for (std::size_t i = 0; i < image.size(); ++i)
                sum += (double(image[i]) - double(truth[i])) * (double(image[i]) - double(truth[i]));
            values.push_back(16 * sum / double(image.size()));
        }
        return moments(values);
    };
    const Moments one = variance(1), two = variance(2);
    const double bounce = 2 * (one.mean - two.mean), camera = one.mean - bounce;
    for (const std::uint32_t branching : {4u, 16u}) {
        const Moments v = variance(branching);
        const double expected = camera + bounce / branching;
        // Errors of the two that the prediction was made of: (2/B - 1) of the first, 2 - 2/B of the second.
        const double a = 2.0 / branching - 1, b = 2 - 2.0 / branching;
        const double se = std::sqrt((v.variance + a * a * one.variance + b * b * two.variance) / v.n);
        INFO("B = " << branching << ": " << v.mean << ", expected " << expected << " +- " << se);
        CHECK(std::fabs(v.mean - expected) < 4.5 * se);
        CHECK(v.mean < 0.6 * one.mean);
    }
}
