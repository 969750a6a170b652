#include "laws.h"

#include <koksma/measure/slope.h>
#include <koksma/measure/statistics.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>
#include <limits>

using namespace koksma;
using namespace koksma::test;

namespace {

/// MSE = (level spp^slope)^2 at 4, 8, .. without noise.
std::vector<RatePoint> exact_curve(double level, double slope, int points, std::size_t n) {
    std::vector<RatePoint> curve;
    for (int i = 0; i < points; ++i) {
        const double spp = std::ldexp(4.0, i), rmse = level * std::pow(spp, slope);
        curve.push_back({spp, std::vector<double>(n, rmse * rmse)});
    }
    return curve;
}

}  // namespace

TEST_CASE("an exact power law has its exponent and level", "[unit][measure]") {
    for (const double slope : {-0.5, -0.75, -1.0, -1.5, 0.0}) {
        const SlopeFit fit = fit_slope(exact_curve(0.3, slope, 7, 4));
        CAPTURE(slope);
        CHECK(fit.value == Approx(slope).margin(1e-12));
        CHECK(std::exp(fit.intercept) == Approx(0.3).epsilon(1e-10));
        CHECK(fit.rmse_at(1000) == Approx(0.3 * std::pow(1000, slope)).epsilon(1e-10));
        CHECK(fit.lo == Approx(slope).margin(1e-9));
        CHECK(fit.hi == Approx(slope).margin(1e-9));
        CHECK(fit.points == 7);
        CHECK(fit.skipped == 0);
        CHECK(fit.from == 4);
        CHECK(fit.to == 256);
    }
}

TEST_CASE("a slope of two points is the quotient of differences and its interval that of Welch", "[unit][measure]") {
    const std::vector<RatePoint> curve = {{4, {1.0, 1.2, 0.8, 1.0}}, {16, {0.25, 0.3, 0.2, 0.25}}};
    const SlopeFit fit = fit_slope(curve);
    CHECK(fit.value == Approx(-0.5));  // MSE a fourth, RMSE a half, over a factor of 4
    const double relative = 0.08 / 3 / 4;
    CHECK(fit.standard_error == Approx(0.5 * std::sqrt(2 * relative) / std::log(4.0)));
    CHECK(fit.dof == Approx(8));
    CHECK(fit.hi - fit.value == Approx(student_t_quantile(1 - 0.41 * 0.05, 8) * fit.standard_error).epsilon(1e-6));
    CHECK(std::isnan(fit.straight_p));
}

TEST_CASE("points count by their replicates", "[unit][measure]") {
    // Three points off a line: the middle one is high by a factor e in MSE, the last has three times the replicates.
    const double e = std::exp(1.0);
    const std::vector<RatePoint> curve = {{1, {1, 1}}, {e, {e, e}}, {e * e, {1, 1, 1, 1, 1, 1}}};
    // weights 2, 2, 6 at x = 0, 1, 2 with y = 0, 0.5, 0: mean x 1.4, sum w (x - 1.4)^2 = 6.4, sum w (x - 1.4) y = -0.4
    CHECK(fit_slope(curve).value == Approx(-0.4 / 6.4));
}

TEST_CASE("points below the floor are skipped and counted", "[unit][measure]") {
    auto curve = exact_curve(0.3, -1, 5, 3);
    curve.push_back({128, {-1e-6, 1e-7, 2e-7}});
    curve.push_back({256, {0, 0, 0}});
    curve.push_back({512, {1e-9, std::nan(""), 1e-9}});
    curve.push_back({1024, {}});
    const SlopeFit fit = fit_slope(curve);
    CHECK(fit.value == Approx(-1));
    CHECK(fit.points == 5);
    CHECK(fit.skipped == 4);
    CHECK(fit.to == 64);
}

TEST_CASE("fewer than two places give no slope", "[unit][measure]") {
    for (const auto& curve : {std::vector<RatePoint>{}, {{4, {1, 2}}}, {{4, {1, 2}}, {8, {-1, -2}}}, {{4, {1, 2}}, {4, {2, 3}}}}) {
        const SlopeFit fit = fit_slope(curve);
        CHECK(std::isnan(fit.value));
        CHECK(std::isnan(fit.lo));
        CHECK_FALSE(fit.has_interval());
    }
    CHECK_THROWS_AS(fit_slope(std::vector<RatePoint>{{0, {1}}, {2, {1}}}), Error);
    CHECK_THROWS_AS(fit_slope(exact_curve(1, -1, 3, 2), 95), Error);
    CHECK_THROWS_AS(fit_slope({}, 95), Error);
}

TEST_CASE("one replicate a point gives a slope and no interval, unless others tell the spread", "[unit][measure]") {
    auto curve = exact_curve(0.3, -1, 5, 1);
    const SlopeFit bare = fit_slope(curve);
    CHECK(bare.value == Approx(-1));
    CHECK_FALSE(bare.has_interval());
    CHECK(std::isnan(bare.straight_p));
    Generator g(1);
    curve[0].errors = replicates(chi2_law(0.2), 8, 0.09 / 16, g);
    CHECK(fit_slope(curve).has_interval());
    CHECK(fit_slope(curve).dof > 6.9);
    const std::vector<RatePoint> two = {{4, {1.0, 1.2, 0.8, 1.0}}, {16, {0.25}}};
    CHECK(fit_slope(two).standard_error == Approx(0.5 * std::sqrt(0.08 / 3 * (0.25 + 1)) / std::log(4.0)));
}

TEST_CASE("a bent curve fails the test of straightness and a straight one passes as often as it should", "[unit][measure]") {
    const double rejected = 1 - coverage(2000, [](Generator& g) {
        std::vector<RatePoint> curve;
        for (int i = 2; i < 9; ++i) curve.push_back({std::ldexp(1.0, i), replicates(chi2_law(0.1), 8, std::ldexp(1.0, -i), g)});
        return fit_slope(curve).straight_p > 0.05;
    });
    CHECK(rejected > 0.03);  // 0.05 expected; sd 0.005
    CHECK(rejected < 0.07);
    // A reference with an error of its own bends a curve: MSE = 1/N + floor
    Generator g(2);
    std::vector<RatePoint> bent;
    for (int i = 2; i < 9; ++i) bent.push_back({std::ldexp(1.0, i), replicates(chi2_law(0.1), 8, std::ldexp(1.0, -i) + 0.01, g)});
    CHECK(fit_slope(bent).straight_p < 1e-6);
    CHECK(fit_slope(bent).value > -0.45);
}

TEST_CASE("a slope of prefixes is that of their means, and knows that points depend on each other", "[unit][measure]") {
    // Every render is 0.7, 1.0 or 1.3 times the same curve at all its prefixes: the slope is known exactly, though no point is.
    const std::vector<double> spp = {4, 16, 64};
    std::vector<std::vector<double>> renders;
    for (const double factor : {0.7, 1.0, 1.3}) renders.push_back({factor, factor / 16, factor / 256});
    const SlopeFit whole = fit_prefix_slope(spp, renders);
    CHECK(whole.value == Approx(-1));
    CHECK(whole.hi - whole.lo < 1e-9);
    std::vector<RatePoint> as_if_independent;
    for (std::size_t i = 0; i < spp.size(); ++i) as_if_independent.push_back({spp[i], {renders[0][i], renders[1][i], renders[2][i]}});
    CHECK(fit_slope(as_if_independent).value == Approx(-1));
    CHECK(fit_slope(as_if_independent).hi - fit_slope(as_if_independent).lo > 0.1);

    renders[2][2] = 2;  // one render that is off at one prefix: half-width by hand
    const SlopeFit fit = fit_prefix_slope(spp, renders);
    std::vector<double> left;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        left.push_back(0.5 * std::log((renders[a][2] + renders[b][2]) / (renders[a][0] + renders[b][0])) / std::log(16.0));  // of equal weights: first and last
    }
    const double mean = (left[0] + left[1] + left[2]) / 3;
    double square = 0;
    for (const double v : left) square += (v - mean) * (v - mean);
    CHECK(fit.hi - fit.value == Approx(student_t_factor(0.95, 2) * std::sqrt(2.0 / 3 * square)));

    CHECK(std::isnan(fit_prefix_slope(spp, {renders[0]}).lo));
    CHECK_THROWS_AS(fit_prefix_slope(spp, {{1, 2}}), Error);
    renders[0][0] = -100;
    CHECK(std::isnan(fit_prefix_slope(spp, renders).value));
}
