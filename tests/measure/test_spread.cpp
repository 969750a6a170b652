// The spread between groups: its interval, its test and its ratio on errors of known law. The coverages that the header names come
// from here:  test_measure "[spread]" -s

#include "laws.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/spread.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>

using namespace koksma;
using namespace koksma::test;

namespace {

/// 8 groups of `n` replicates whose RMSE differ by `between` (standard deviation of the logarithm), and one more.
struct Sample {
    std::vector<double> first;
    std::vector<std::vector<double>> groups;
    Sample(Generator& g, double between, int n) {
        const Law law = chi2_law(0.1);
        std::normal_distribution<double> normal;
        first = replicates(law, n, 4.0, g);
        for (int k = 0; k < 8; ++k) groups.push_back(replicates(law, n, std::exp(2 * between * normal(g)), g));
    }
};

}  // namespace

TEST_CASE("intervals of a spread between groups cover it 93 to 99.5 percent of the time", "[unit][measure][spread]") {
    for (const double between : {0.0, 0.02, 0.05, 0.2})
        for (const int n : {4, 8}) {
            const double covered = coverage(2000, [&](Generator& g) {
                const Sample s(g, between, n);
                return spread(s.first, s.groups).between.interval().contains(between);
            });
            INFO("spread " << between << ", " << n << " replicates: covered " << covered);
            CHECK(covered > 0.93);
            CHECK(covered < 0.995);
        }
}

TEST_CASE("equal groups are found different as often as the confidence says", "[unit][measure][spread]") {
    const double found = coverage(4000, [&](Generator& g) {
        const Sample s(g, 0.0, 8);
        return spread(s.first, s.groups).p_equal < 0.05;
    });
    CHECK(found > 0.03);
    CHECK(found < 0.07);
    // And what the interval says agrees: it begins above 0 in half of those.
    const double above = coverage(4000, [&](Generator& g) {
        const Sample s(g, 0.0, 8);
        return spread(s.first, s.groups).between.lo > 0;
    });
    CHECK(above > 0.013);
    CHECK(above < 0.04);
}

TEST_CASE("one group over the mean of others covers the true ratio of RMSE", "[unit][measure][spread]") {
    for (const double between : {0.0, 0.1}) {
        const double covered = coverage(2000, [&](Generator& g) {
            const Sample s(g, between, 8);
            return spread(s.first, s.groups).first.interval().contains(2.0);
        });
        INFO("spread " << between << ": covered " << covered);
        CHECK(covered > 0.93);
        CHECK(covered < 0.985);
    }
}

TEST_CASE("a spread refuses too few groups and replicates, and has no value for errors below the floor", "[unit][measure][spread]") {
    CHECK_THROWS_AS(spread(std::vector{1.0, 2.0}, {{1.0, 2.0}}), Error);
    CHECK_THROWS_AS(spread(std::vector{1.0, 2.0}, {{1.0, 2.0}, {1.0}}), Error);
    CHECK_THROWS_AS(spread(std::vector{1.0, 2.0}, {{1.0, 2.0}, {1.0, 2.0}}, 1.0), Error);
    const Spread s = spread(std::vector{1.0, 2.0}, {{1.0, 2.0}, {-3.0, 2.0}});
    CHECK(std::isnan(s.between.value));
    CHECK(std::isnan(s.first.lo));
}

TEST_CASE("an interpolated gain lies on the line between its neighbours", "[unit][measure]") {
    const std::vector<double> a{1, 1.1, 0.9}, below{4, 4.4, 3.6}, above{1, 1.1, 0.9};
    CHECK(std::abs(interpolated_gain(a, below, above, 0.5).value - 2) < 1e-12);
    CHECK(std::abs(interpolated_gain(a, below, above, 0).value - 4) < 1e-12);
    const Gain at_end = interpolated_gain(a, below, above, 1), plain = gain(a, above);
    CHECK(std::abs(at_end.lo - plain.lo) < 1e-9);
    CHECK(std::abs(at_end.hi - plain.hi) < 1e-9);
    CHECK(interpolated_gain(a, {}, above, 0.5).value != interpolated_gain(a, {}, above, 0.5).value);
}
