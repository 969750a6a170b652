// Do 95 % intervals cover 95 %? The tables in the headers of koksma/measure come from here:  test_measure "[coverage]" -s
// The sd of a coverage near 0.95 over n repeats is 0.22 / sqrt(n): 0.0022 for 10000, 0.0035 for 4000.

#include "laws.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/rmse_estimate.h>
#include <koksma/measure/slope.h>
#include <koksma/measure/tails.h>
#include <koksma_catch.h>

#include <algorithm>

using namespace koksma;
using namespace koksma::test;

namespace {

constexpr int kReplicates[] = {4, 8, 16};

double metric_coverage(const Law& law, int n) {
    return coverage(10000, [&](Generator& g) { return metric_estimate(replicates(law, n, 1, g)).interval().contains(1); });
}

double mean_coverage(const Law& law, int n) {
    return coverage(10000, [&](Generator& g) { return mean_estimate(replicates(law, n, 1, g)).interval().contains(1); });
}

double gain_coverage(const Law& a, const Law& b, int n) {
    return coverage(10000, [&](Generator& g) {
        const Gain r = gain(replicates(a, n, 1, g), replicates(b, n, 3, g));
        return Interval{r.lo, r.hi}.contains(3);
    });
}

/// RMSE = 0.2 spp^-0.75 at `points` powers of two from 4; the law is `first` in the lower half and `last` in the upper.
double slope_coverage(const Law& first, const Law& last, int points, int n) {
    return coverage(4000, [&](Generator& g) {
        std::vector<RatePoint> curve;
        for (int i = 0; i < points; ++i) {
            const double spp = std::ldexp(4.0, i);
            curve.push_back({spp, replicates(2 * i < points ? first : last, n, 0.04 * std::pow(spp, -1.5), g)});
        }
        const SlopeFit fit = fit_slope(curve);
        return Interval{fit.lo, fit.hi}.contains(-0.75);
    });
}

/// The same of prefixes: a render's error at n is the mean of what it has at n and half of what it had at n / 2.
double prefix_slope_coverage(const Law& law, int points, int n) {
    return coverage(4000, [&](Generator& g) {
        std::vector<double> spp;
        std::vector<std::vector<double>> errors(static_cast<std::size_t>(n));
        for (int i = 0; i < points; ++i) spp.push_back(std::ldexp(4.0, i));
        for (std::vector<double>& render : errors) {
            double carried = law.draw(g);
            for (int i = 0; i < points; ++i) {
                carried = 0.5 * (carried + law.draw(g));
                render.push_back(carried * std::pow(spp[static_cast<std::size_t>(i)], -1.5));
            }
        }
        return [fit = fit_prefix_slope(spp, errors)] { return fit.lo <= -0.75 && -0.75 <= fit.hi; }();
    });
}

}  // namespace

TEST_CASE("metric intervals cover 93 to 97 percent, under heavy tails too", "[unit][measure][coverage]") {
    for (const Law& law : {chi2_law(0.02), chi2_law(0.1), chi2_law(0.25), chi2_law(0.5), chi2_law(1), lognormal_law(0.5), lognormal_law(1), pareto_law(3), pareto_law(2.1)})
        for (const int n : kReplicates) {
            const double covered = metric_coverage(law, n), plain = mean_coverage(law, n);
            CAPTURE(law.name, n, covered, plain);
            CHECK(covered > 0.93);
            CHECK(covered < 0.97);
            CHECK(covered > heavy_tailed_coverage(n).rmse - 0.005);
        }
}

TEST_CASE("gain intervals cover 93 to 97 percent for chi-squared replicate errors", "[unit][measure][coverage]") {
    for (const auto& [sd_a, sd_b] : {std::pair{0.02, 0.02}, {0.02, 0.5}, {0.25, 0.25}, {0.5, 0.1}, {0.5, 0.5}})
        for (const int n : kReplicates) {
            const double covered = gain_coverage(chi2_law(sd_a), chi2_law(sd_b), n);
            CAPTURE(sd_a, sd_b, n, covered);
            CHECK(covered > 0.93);
            CHECK(covered < 0.97);
        }
}

TEST_CASE("gain intervals under heavy tails cover as much as reports say", "[unit][measure][coverage]") {
    for (const int n : kReplicates) {
        double least = 1;
        for (const auto& [a, b] : {std::pair{chi2_law(1), chi2_law(1)}, {lognormal_law(1), lognormal_law(1)}, {lognormal_law(1), chi2_law(0.1)},
                                   {pareto_law(3), pareto_law(3)}, {pareto_law(2.1), pareto_law(2.1)}, {pareto_law(2.1), chi2_law(0.1)}}) {
            const double covered = gain_coverage(a, b, n);
            CAPTURE(a.name, b.name, n, covered);
            CHECK(covered < 0.985);
            least = std::min(least, covered);
        }
        CAPTURE(n, least);
        CHECK(std::abs(least - heavy_tailed_coverage(n).gain) < 0.01);
    }
}

TEST_CASE("slope intervals cover 93 to 97 percent for chi-squared replicate errors", "[unit][measure][coverage]") {
    for (const auto& [first, last] : {std::pair{0.02, 0.02}, {0.1, 0.1}, {0.5, 0.5}, {0.02, 0.5}})
        for (const int points : {2, 4, 8})
            for (const int n : kReplicates) {
                const double covered = slope_coverage(chi2_law(first), chi2_law(last), points, n);
                CAPTURE(first, last, points, n, covered);
                CHECK(covered > 0.93);
                CHECK(covered < 0.97);
            }
}

TEST_CASE("slope intervals under heavy tails cover as much as reports say", "[unit][measure][coverage]") {
    for (const int n : kReplicates) {
        double least = 1;
        for (const auto& [first, last] : {std::pair{chi2_law(1), chi2_law(1)}, {lognormal_law(1), lognormal_law(1)}, {pareto_law(3), pareto_law(3)},
                                          {pareto_law(2.1), pareto_law(2.1)}, {chi2_law(0.1), lognormal_law(1)}, {chi2_law(0.1), pareto_law(2.1)}}) {
            const double covered = slope_coverage(first, last, 6, n);
            CAPTURE(first.name, last.name, n, covered);
            CHECK(covered < 0.985);
            least = std::min(least, covered);
        }
        CAPTURE(n, least);
        CHECK(std::abs(least - heavy_tailed_coverage(n).slope) < 0.01);
    }
}

TEST_CASE("slope intervals of prefixes cover 93 to 97 percent for chi-squared replicate errors", "[unit][measure][coverage]") {
    for (const double sd : {0.02, 0.1, 0.25})
        for (const int n : kReplicates) {
            const double covered = prefix_slope_coverage(chi2_law(sd), 4, n);
            CAPTURE(sd, n, covered);
            CHECK(covered > 0.93);
            CHECK(covered < 0.97);
        }
}
