#include "draw.h"

#include <samplers/lhs.h>

#include <koksma_catch.h>

#include <cmath>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("lhs puts one value of every dimension into each stratum, at any count", "[unit][samplers]") {
    for (const std::uint64_t n : {1u, 2u, 3u, 5u, 7u, 16u, 37u, 100u, 1024u, 5000u})
        for (std::uint64_t seed = 0; seed < 4; ++seed)
            for (const std::uint8_t arity : {std::uint8_t{1}, std::uint8_t{2}}) {
                const Points p = draw<LhsSampler>("lhs", {.count = n, .seed = seed, .arity = arity});
                for (std::size_t d = 0; d < 10; ++d) REQUIRE(one_per_stratum(p, d, n));
            }
}

TEST_CASE("lhs has the closed forms of independent orders: marginals stratified, products as random", "[unit][samplers]") {
    // Mean of x: 1 / (12 N^3). Mean of (x - 1/2)(y - 1/2): orders are independent, so 1 / (144 N) up to 1/N of it.
    constexpr int kSeeds = 1000;
    constexpr double kN = 100;
    double linear = 0, product = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Points p = draw<LhsSampler>("lhs", {.count = 100, .seed = seed, .dimensions = 2, .arity = 2});
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
    REQUIRE(product * 144 * kN == Approx(1).margin(margin + 1 / kN).epsilon(0));
}

TEST_CASE("An lhs index beyond the count is still a valid sample, and so is dimension 4000", "[unit][samplers]") {
    for (const std::uint64_t first : {100ull, (1ull << 32) + 5, ~0ull - 100})
        for (const float x : draw<LhsSampler>("lhs", {.count = 50, .first = first, .dimensions = 4000}).values) REQUIRE((x >= 0 && x < 1));
}
