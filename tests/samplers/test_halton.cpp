#include "draw.h"

#include <samplers/halton.h>

#include <koksma_catch.h>

#include <cmath>

using namespace koksma;
using namespace koksma::test;

namespace {
const HaltonBase& base_of(std::uint32_t prime) {
    const HaltonBase* b = halton_bases();
    while (b->base != prime) ++b;
    return *b;
}
}  // namespace

TEST_CASE("Unscrambled Halton points equal the exact fractions", "[unit][samplers]") {
    // Radical inverses by hand, indices 1 .. 6 in bases 2, 3, 5, 7: numerator, denominator.
    constexpr std::uint64_t kFirst[6][4][2] = {{{1, 2}, {1, 3}, {1, 5}, {1, 7}},  {{1, 4}, {2, 3}, {2, 5}, {2, 7}},
                                               {{3, 4}, {1, 9}, {3, 5}, {3, 7}},  {{1, 8}, {4, 9}, {4, 5}, {4, 7}},
                                               {{5, 8}, {7, 9}, {1, 25}, {5, 7}}, {{3, 8}, {2, 9}, {6, 25}, {6, 7}}};
    const Points p = draw<HaltonSampler>("halton:randomize=none", {.count = 7});
    for (std::size_t d = 0; d < 4; ++d) {
        REQUIRE(p(d, 0) == 0.0f);
        for (std::size_t i = 1; i <= 6; ++i) REQUIRE(p(d, i) == unit_float_ceil(kFirst[i - 1][d][0], kFirst[i - 1][d][1]));
    }
    constexpr std::uint64_t kLater[5][2] = {{9987, 16384}, {4849, 19683}, {2973, 15625}, {11961, 16807}, {4035, 14641}};
    const Points q = draw<HaltonSampler>("halton:randomize=none", {.count = 1, .first = 12345});
    for (std::size_t d = 0; d < 5; ++d) REQUIRE(q(d, 0) == unit_float_ceil(kLater[d][0], kLater[d][1]));
}

TEST_CASE("Radical inverses are right for large bases and indices", "[unit][samplers]") {
    struct Case {
        std::uint32_t base;
        std::uint64_t index;
        double value;  // exact digits by rational arithmetic
    };
    const auto cube = [](std::uint64_t b) { return b * b * b - 1; };
    const Case cases[] = {{2, (1ull << 32) + 1, .50000000011641532},  {3, 1ull << 32, .53723727477847385},
                          {3, 3486784400ull, .9999999997132028},      {541, cube(541), .99999999368449323},
                          {1009, cube(1009), .99999999902652119},     {7919, 1000000000000ull, .52661665733843646},
                          {7919, (1ull << 52) - 1, .3919485551626496}};
    for (const Case& c : cases) {
        const float x = radical_inverse(base_of(c.base), c.index);
        const double k = c.base == 2 ? std::floor(c.value * 0x1p24) : std::min(std::ceil(c.value * 0x1p24), 0x1p24 - 1);
        REQUIRE(x < 1.0f);
        REQUIRE(static_cast<double>(x) == k * 0x1p-24);
        REQUIRE(radical_inverse_bits(base_of(c.base), c.index) * 0x1p-32 == Approx(c.value).margin(0x1p-31).epsilon(0));
    }
    for (const std::uint32_t b : {2u, 3u, 5u, 541u, 1009u, 1619u, 2003u, 8161u}) {  // the last point of b^m: nearest to 1
        std::uint64_t power = b;
        while (power < (~0ull) / b) {
            REQUIRE(radical_inverse(base_of(b), power - 1) < 1.0f);
            power *= b;
        }
        REQUIRE(radical_inverse(base_of(b), ~0ull) < 1.0f);
    }
}

TEST_CASE("The short and the long way to a radical inverse agree with integer arithmetic", "[unit][samplers]") {
    for (const std::uint32_t b : {3u, 7u, 61u, 541u, 7919u})
        for (std::uint64_t n = 0; n < 200000; n += 1 + n / 7) {
            std::uint64_t numerator = 0, denominator = 1;
            for (std::uint64_t i = n; i != 0; i /= b) numerator = numerator * b + i % b, denominator *= b;
            REQUIRE(radical_inverse(base_of(b), n) == unit_float_ceil(numerator, denominator));
            const std::uint64_t high = (numerator << 24) / denominator, low = (((numerator << 24) % denominator) << 8) / denominator;
            REQUIRE(radical_inverse_bits(base_of(b), n) == (high << 8) + low);
        }
}

TEST_CASE("Every aligned block of b^m Halton points has one value in each stratum, however randomised", "[unit][samplers]") {
    for (const char* spec : {"halton:randomize=none", "halton:randomize=digits", "halton:randomize=owen"})
        for (std::uint64_t seed = 0; seed < 4; ++seed)
            for (std::size_t d = 0; d < 40; ++d) {
                const std::uint64_t b = kPrimes[d];
                for (std::uint64_t n = b; n <= 3000; n *= b)
                    for (const std::uint64_t block : {0ull, 1ull, 5ull}) {
                        const Points p = draw<HaltonSampler>(spec, {.count = n, .first = block * n, .seed = seed, .dimensions = 40});
                        REQUIRE(one_per_stratum(p, d, n));
                    }
            }
}

TEST_CASE("Two dimensions of Halton have one point in each cell of their bases", "[unit][samplers]") {
    for (const char* spec : {"halton:randomize=none", "halton:randomize=digits", "halton:randomize=owen"})
        for (std::uint64_t seed = 0; seed < 4; ++seed)
            for (std::size_t d = 0; d + 1 < 10; ++d) {
                const std::uint64_t b0 = kPrimes[d], b1 = kPrimes[d + 1];
                REQUIRE(one_per_cell(draw<HaltonSampler>(spec, {.count = b0 * b1, .seed = seed}), d, b0, d + 1, b1));
            }
}

TEST_CASE("Trailing zeros are permuted: index 0 is uniform over seeds", "[unit][samplers]") {
    for (const char* spec : {"halton:randomize=cp", "halton:randomize=digits", "halton:randomize=owen"}) {
        std::vector<double> high(80, 0), low(80, 0);
        for (std::uint64_t seed = 0; seed < 8192; ++seed) {
            const Points p = draw<HaltonSampler>(spec, {.seed = seed});
            for (std::size_t d = 0; d < 10; ++d) high[d * 8 + (p.bits24(d, 0) >> 21)] += 1, low[d * 8 + (p.bits24(d, 0) >> 6 & 7)] += 1;
        }
        // 1024 expected, deviation 30: six deviations.
        for (const double h : high) REQUIRE(std::abs(h - 1024) < 180);
        for (const double h : low) REQUIRE(std::abs(h - 1024) < 180);
    }
}

TEST_CASE("Owen-scrambled Halton has the variance of nested scrambling in each base", "[unit][samplers]") {
    // At N = b^m the error of x is that of one uniform number in each stratum: variance 1 / (12 N^3).
    constexpr int kSeeds = 400;
    for (const auto& [d, n] : {std::pair<std::size_t, std::uint64_t>{1, 243}, {2, 125}, {4, 121}, {9, 29}}) {
        double square = 0;
        for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
            const Points p = draw<HaltonSampler>("halton", {.count = n, .seed = seed});
            double mean = 0;
            for (std::size_t i = 0; i < n; ++i) mean += (p(d, i) + 0x1p-25) / static_cast<double>(n);
            square += (mean - 0.5) * (mean - 0.5) / kSeeds;
        }
        REQUIRE(square * 12 * std::pow(static_cast<double>(n), 3) == Approx(1).margin(6 * std::sqrt(2.0 / kSeeds)).epsilon(0));
    }
}

TEST_CASE("Halton indices beyond 2^32 are values like any other", "[unit][samplers]") {
    for (const char* spec : {"halton:randomize=none", "halton:randomize=cp", "halton:randomize=digits", "halton:randomize=owen"}) {
        const Points near = draw<HaltonSampler>(spec, {.count = 64, .first = 0, .dimensions = 1024});
        for (const std::uint64_t first : {1ull << 32, 1ull << 52, ~0ull - 64}) {
            const Points far = draw<HaltonSampler>(spec, {.count = 64, .first = first, .dimensions = 1024});
            for (const float x : far.values) REQUIRE((x >= 0 && x < 1));
            REQUIRE(far.values != near.values);
        }
    }
}
