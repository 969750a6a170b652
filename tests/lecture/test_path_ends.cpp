// How paths end, in furnaces, whose bias and variance are known.

#include "estimates.h"

#include <koksma/integrators/lecture/roulette.h>

#include <fmt/format.h>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("truncation has the bias of the geometric series, and the ledger says it", "[lecture]") {
    for (const float albedo : {0.5f, 0.8f}) {
        const double truth = 1.0 / (1.0 - double(albedo));
        for (const int n : {1, 2, 4, 7}) {
            INFO("albedo " << albedo << ", depth " << n);
            const EstimateResult r =
                Estimator(empty_furnace(albedo, -1), with(Technique::bsdf, "depth=" + std::to_string(n))).render("random", 16, 1);
            const double expected = truth * (1.0 - std::pow(double(albedo), n));
            CHECK(std::fabs(r.film.mean().y / expected - 1) < 1e-6);
            const double cut = r.ledger.truncated.weight / double(r.ledger.samples) * double(albedo) * truth;
            CHECK(std::fabs(r.film.mean().y + cut - truth) < 1e-5 * truth);
        }
        for (const double threshold : {0.9, 0.3, 0.03, 0.001}) {
            INFO("albedo " << albedo << ", threshold " << threshold);
            const EstimateResult r = Estimator(empty_furnace(albedo, -1), with(Technique::bsdf, fmt::format("threshold={}", threshold)))
                                         .render("random", 16, 1);
            const double terms = std::ceil(std::log(threshold) / std::log(double(albedo)));
            CHECK(std::fabs(r.film.mean().y / (truth * (1.0 - std::pow(double(albedo), terms))) - 1) < 1e-5);
            CHECK(std::fabs(r.film.mean().y + r.ledger.truncated.weight / double(r.ledger.samples) * truth - truth) < 1e-5 * truth);
        }
    }
}

TEST_CASE("roulette has no bias, and the variance of its closed form, which the ledger says too", "[lecture]") {
    constexpr double albedo = 0.6, truth = 1.0 / (1.0 - albedo);
    // S = sum of (albedo / q)^n over survived bounces. With W = albedo / q, a = 1 / (1 - albedo W): E[S^2] = a + 2 (a - 1 / (1 - albedo)) /
    // (W - 1).
    const auto variance = [&](double q) {
        if (q == albedo) return albedo / ((1 - albedo) * (1 - albedo));
        const double w = albedo / q, a = 1 / (1 - albedo * w);
        return a + 2 / (w - 1) * (a - truth) - truth * truth;
    };
    struct Case {
        const char* end;
        double q;
    };
    for (const Case c :
         {Case{"constant=0.6", 0.6}, {"constant=0.5", 0.5}, {"constant=0.8", 0.8}, {"reflectance", 0.6}, {"throughput", 0.6}})
        for (const RouletteNumber number : {RouletteNumber::own, RouletteNumber::rescaled}) {
            INFO(c.end << ", " << name(number) << " number");
            EstimatorSettings s = with(Technique::bsdf, c.end);
            s.number = number;
            const Estimator e(empty_furnace(float(albedo), -1, 8), s);
            check_noise(measure(e, 256, 8), truth, 5e-3);
            const Moments v = sample_variance(e, truth, 64, 32);
            const double expected = variance(c.q), se = std::sqrt(v.variance / v.n);
            INFO("variance " << v.mean << " +- " << se << ", expected " << expected);
            CHECK(std::fabs(v.mean - expected) < 4.5 * se);
            CHECK(se < 0.1 * expected);
            const Ledger ledger = e.render("random", 256, 5).ledger;
            CHECK(std::fabs(ledger.roulette.excess / double(ledger.samples) * truth * truth / expected - 1) < 0.05);
            CHECK(ledger.truncated.rays == 0);
        }
}

TEST_CASE("a rescaled number is uniform again, and stays below 1", "[lecture]") {
    for (const float q : {0.1f, 0.5f, 0.75f, 1.0f}) {
        CHECK(rescaled(0.0f, q).u == 0.0f);
        const float last = std::nextafter(q, 0.0f);
        CHECK(rescaled(last, q).survives);
        CHECK(rescaled(last, q).u < 1.0f);
        CHECK(rescaled(last, q).u > 0.999f);
        if (q < 1.0f) CHECK_FALSE(rescaled(q, q).survives);
    }
}

TEST_CASE("I_roulette of x^2 has the variance that is known", "[lecture]") {
    constexpr int kCount = 1 << 18;
    const auto square = [](float x) { return double(x) * double(x); };
    for (const auto& [p, expected] : {std::pair{0.5f, 13.0 / 45}, std::pair{0.1f, 1.0 / (0.1 * 5) - 1.0 / 9}, std::pair{1.0f, 4.0 / 45}}) {
        const std::uint8_t two[]{2};
        const auto source = samplers().make("random")->bind({1, 1, kCount, 1, plain_layout(two)});
        std::vector<SampleId> ids;
        for (std::uint64_t i = 0; i < kCount; ++i) ids.push_back({{0, 0}, i});
        std::vector<float> u(2 * kCount);
        const DimensionLayout layout = plain_layout(two);
        source->fill(ids, layout.slots(), u.data(), kCount);
        std::vector<double> one, separate;
        for (std::size_t i = 0; i < kCount; ++i) {
            one.push_back(i_roulette(square, u[i], p));
            separate.push_back(i_roulette(square, u[i], u[kCount + i], p));
        }
        for (const auto& values : {one, separate}) {
            const Moments m = moments(values);
            INFO("P = " << p << ": mean " << m.mean << ", variance " << m.variance);
            CHECK(std::fabs(m.mean - 1.0 / 3) < 4.5 * std::sqrt(expected / kCount));
            CHECK(std::fabs(m.variance / expected - 1) < 0.03);
        }
    }
}
