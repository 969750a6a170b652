#include "draw.h"

#include <samplers/pmj02.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

namespace {
constexpr const char* kStratified[] = {"pmj02:randomize=none", "pmj02:randomize=xor", "pmj02:randomize=owen"};
}

TEST_CASE("The first 2^m entries of every table have one point in each elementary interval", "[unit][samplers]") {
    for (std::uint32_t t = 0; t < kPmjTables; ++t) {
        const std::uint16_t* table = pmj_tables() + 2 * t * kPmjPoints;
        for (int m = 0; m <= 12; ++m)
            for (int a = 0; a <= m; ++a) {
                std::vector<int> hits(std::size_t{1} << m, 0);
                for (std::uint32_t i = 0; i < 1u << m; ++i)
                    ++hits[((std::uint32_t{table[2 * i]} >> (16 - a)) << (m - a)) | (std::uint32_t{table[2 * i + 1]} >> (16 - (m - a)))];
                bool one_each = true;
                for (const int h : hits) one_each = one_each && h == 1;
                REQUIRE(one_each);
            }
    }
}

TEST_CASE("Tables are not each other's copies", "[unit][samplers]") {
    std::set<std::pair<int, int>> points;
    for (std::uint32_t i = 0; i < kPmjTables * kPmjPoints; ++i) points.insert({pmj_tables()[2 * i], pmj_tables()[2 * i + 1]});
    REQUIRE(points.size() > kPmjTables * kPmjPoints - 10);  // one point twice: 2^15 choose 2 pairs at 2^-32
}

TEST_CASE("Without a randomisation the first slot is the first table", "[unit][samplers]") {
    const Points p = draw<Pmj02Sampler>("pmj02:randomize=none", {.count = 4096, .arity = 2});
    for (std::size_t i = 0; i < 4096; ++i)
        REQUIRE((p.bits24(0, i) == pmj_tables()[2 * i] * 256u && p.bits24(1, i) == pmj_tables()[2 * i + 1] * 256u));
}

TEST_CASE("xor and owen keep the elementary intervals of every prefix of 2^m, in every slot", "[unit][samplers]") {
    for (const char* spec : kStratified)
        for (std::uint64_t seed = 0; seed < 3; ++seed)
            for (int m = 0; m <= 12; m += 2 - m % 2) {
                const std::uint64_t n = 1ull << m;
                const Points p = draw<Pmj02Sampler>(spec, {.count = n, .seed = seed, .arity = 2});
                for (std::size_t d = 0; d < 10; d += 2)
                    for (std::uint64_t nx = 1; nx <= n; nx *= 2) REQUIRE(one_per_cell(p, d, nx, d + 1, n / nx));
            }
}

TEST_CASE("Nested scrambling of pmj02 has the variances of nets", "[unit][samplers]") {
    // As for sobol at N = 256: mean of x 1 / (12 N^3), of (x - 1/2)(y - 1/2) within a slot (28 m / 3 + 16 / 9) / (256 N^3).
    constexpr int kSeeds = 1000, kM = 8;
    constexpr double kN = 1 << kM;
    double linear = 0, product = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Points p = draw<Pmj02Sampler>("pmj02:randomize=owen", {.count = 256, .seed = seed, .dimensions = 4, .arity = 2});
        double x = 0, xy = 0;
        for (std::size_t i = 0; i < p.count; ++i) {
            x += (p(2, i) + 0x1p-25 - 0.5) / kN;
            xy += (p(2, i) + 0x1p-25 - 0.5) * (p(3, i) + 0x1p-25 - 0.5) / kN;
        }
        linear += x * x / kSeeds;
        product += xy * xy / kSeeds;
    }
    const double margin = 6 * std::sqrt(2.0 / kSeeds);
    REQUIRE(linear * 12 * kN * kN * kN == Approx(1).margin(margin).epsilon(0));
    REQUIRE(product * 256 * kN * kN * kN / (28.0 * kM / 3 + 16.0 / 9) == Approx(1).margin(1.3 * margin).epsilon(0));
}

TEST_CASE("More samples than a table has are refused with the number", "[unit][samplers]") {
    REQUIRE_NOTHROW(draw<Pmj02Sampler>("pmj02", {.count = 4096}));
    REQUIRE_THROWS_WITH(draw<Pmj02Sampler>("pmj02", {.count = 4097}), Catch::Matchers::Contains("4096") && Catch::Matchers::Contains("4097"));
}

TEST_CASE("Slots of pmj02 are no copies of each other, at dimensions beyond 1024 too", "[unit][samplers]") {
    for (const char* spec : {"pmj02:randomize=none", "pmj02:randomize=cp", "pmj02:randomize=xor", "pmj02:randomize=owen"}) {
        const Points p = draw<Pmj02Sampler>(spec, {.count = 256, .dimensions = 2048, .arity = 2});
        for (const float x : p.values) REQUIRE((x >= 0 && x < 1));
        std::set<std::vector<float>> slots;
        for (auto row = p.values.begin(); row != p.values.end(); row += 256) slots.insert(std::vector<float>(row, row + 256));
        REQUIRE(slots.size() == 2048);
    }
}
