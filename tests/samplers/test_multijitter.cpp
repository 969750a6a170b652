#include "draw.h"

#include <samplers/multijitter.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

namespace {
constexpr const char* kSpecs[] = {"multijitter", "multijitter:order=independent"};
}

TEST_CASE("The grid of multijitter is near a square, and its long columns add up to the count", "[unit][samplers]") {
    for (std::uint32_t n = 1; n <= 3000; ++n) {
        const MultiJitterGrid g = MultiJitterGrid::of(n);
        REQUIRE((g.last >= 1 && g.last <= g.columns && g.columns * (g.rows - 1) + g.last == n));
        REQUIRE((g.columns <= 2 * g.rows && g.rows <= 2 * g.columns));
        REQUIRE((g.longer_before(0) == 0 && g.longer_before(g.columns) == g.last));
        for (std::uint32_t k = 0; k < g.last; ++k) {  // the k-th long column is the one with k long ones before it
            const std::uint32_t c = g.column_of_last(k);
            REQUIRE((g.longer_before(c) == k && g.longer_before(c + 1) == k + 1));
        }
    }
}

TEST_CASE("multijitter has one value of either coordinate in each stratum, at any count", "[unit][samplers]") {
    for (const char* spec : kSpecs)
        for (const std::uint64_t n : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 10u, 11u, 13u, 14u, 16u, 22u, 37u, 64u, 97u, 100u, 101u, 1009u, 1024u})
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                const Points one = draw<MultiJitterSampler>(spec, {.count = n, .seed = seed});
                const Points two = draw<MultiJitterSampler>(spec, {.count = n, .seed = seed, .arity = 2});
                for (std::size_t d = 0; d < 10; ++d) REQUIRE((one_per_stratum(one, d, n) && one_per_stratum(two, d, n)));
            }
}

TEST_CASE("multijitter has one point in each cell of a full grid", "[unit][samplers]") {
    for (const char* spec : kSpecs)
        for (const std::uint32_t n : {4u, 6u, 9u, 12u, 16u, 20u, 64u, 100u, 1024u})
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                const MultiJitterGrid g = MultiJitterGrid::of(n);
                const Points p = draw<MultiJitterSampler>(spec, {.count = n, .seed = seed, .arity = 2});
                REQUIRE(g.full());
                for (std::size_t d = 0; d < 10; d += 2) REQUIRE(one_per_cell(p, d, g.columns, d + 1, g.rows));
            }
}

TEST_CASE("multijitter has the variances of its orders", "[unit][samplers]") {
    // N = m^2. Mean of x: 1 / (12 N^3). (x - 1/2)(y - 1/2): with V = ((m^2 - 1) / (12 m))^2 / (m - 1), the variance of a sum of
    // centred rows (r / m) times a random order of them, correlated orders give 2 V / N^2 (one such sum for all columns, one
    // for all rows), independent ones 2 V / (m N^2) (one for each). Jitter adds 1/N of that, or less.
    constexpr int kSeeds = 1000;
    constexpr double kM = 16, kN = kM * kM;
    const double sum = (kM * kM - 1) / (12 * kM), v = sum * sum / (kM - 1);
    const double expected[2] = {2 * v / (kN * kN), 2 * v / (kM * kN * kN)};
    for (int s = 0; s < 2; ++s) {
        double linear = 0, product = 0;
        for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
            const Points p = draw<MultiJitterSampler>(kSpecs[s], {.count = 256, .seed = seed, .dimensions = 2, .arity = 2});
            double x = 0, xy = 0;
            for (std::size_t i = 0; i < p.count; ++i) {
                x += (p(0, i) + 0x1p-25 - 0.5) / kN;
                xy += (p(0, i) + 0x1p-25 - 0.5) * (p(1, i) + 0x1p-25 - 0.5) / kN;
            }
            linear += x * x / kSeeds;
            product += xy * xy / kSeeds;
        }
        const double margin = 6 * std::sqrt(2.0 / kSeeds);
        REQUIRE(linear * 12 * kN * kN * kN == Approx(1).margin(margin).epsilon(0));
        INFO(kSpecs[s]);
        REQUIRE(product / expected[s] == Approx(1).margin(margin + 1.5 / kN).epsilon(0));
    }
}

TEST_CASE("multijitter is unbiased for products within a slot and across slots", "[unit][samplers]") {
    for (const char* spec : kSpecs)
        for (const std::uint64_t n : {3u, 5u, 7u, 14u, 16u}) {
            constexpr int kSeeds = 10000;
            double sum[3] = {}, square[3] = {};
            for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
                const Points p = draw<MultiJitterSampler>(spec, {.count = n, .seed = seed, .dimensions = 4, .arity = 2});
                double e[3] = {};
                for (std::size_t i = 0; i < n; ++i) {
                    const double x = p(0, i) + 0x1p-25, y = p(1, i) + 0x1p-25, z = p(2, i) + 0x1p-25;
                    e[0] += (y < x ? 0.5 : -0.5) / static_cast<double>(n);
                    e[1] += (x * x * z * z - 1.0 / 9.0) / static_cast<double>(n);
                    e[2] += (x * x * y * y - 1.0 / 9.0) / static_cast<double>(n);
                }
                for (int k = 0; k < 3; ++k) sum[k] += e[k], square[k] += e[k] * e[k];
            }
            for (int k = 0; k < 3; ++k) REQUIRE(std::abs(sum[k]) < 5.0 * std::sqrt(square[k]));  // five standard errors
        }
}

TEST_CASE("A multijitter index beyond the count is still a valid sample", "[unit][samplers]") {
    for (const std::uint64_t first : {100ull, (1ull << 32) + 5, ~0ull - 100})
        for (const float x : draw<MultiJitterSampler>("multijitter", {.count = 50, .first = first, .dimensions = 2048, .arity = 2}).values)
            REQUIRE((x >= 0 && x < 1));
}
