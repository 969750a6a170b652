#include "draw.h"

#include <samplers/permutation.h>
#include <samplers/stratified.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("A keyed permutation is a permutation", "[unit][samplers]") {
    for (std::uint32_t n = 1; n <= 300; ++n) {
        std::set<std::uint32_t> images;
        for (std::uint32_t i = 0; i < n; ++i) images.insert(permute(i, n, derive_key(pixel_key(1, {2, 3}), n)));
        REQUIRE((images.size() == n && *images.rbegin() == n - 1));
    }
}

TEST_CASE("All permutations of four are equally likely", "[unit][samplers]") {
    // 24 classes, expected 5000 each: chi-squared has mean 23 and deviation 6.8; 70 is seven deviations.
    constexpr int kKeys = 120000;
    std::vector<int> hits(256, 0);
    for (int k = 0; k < kKeys; ++k) {
        const Key key = derive_key(pixel_key(0, {k, 0}), 0);
        ++hits[permute(0, 4, key) * 64 + permute(1, 4, key) * 16 + permute(2, 4, key) * 4 + permute(3, 4, key)];
    }
    double chi2 = 0;
    int classes = 0;
    for (const int h : hits)
        if (h > 0) chi2 += (h - kKeys / 24.0) * (h - kKeys / 24.0) / (kKeys / 24.0), ++classes;
    REQUIRE(classes == 24);
    REQUIRE(chi2 < 70);
}

TEST_CASE("The grid is the divisor pair nearest to a square, or multi-jittered when that is too long", "[unit][samplers]") {
    const auto is = [](std::uint32_t n, std::uint32_t c, std::uint32_t r, bool m) {
        const StratifiedGrid g = StratifiedGrid::of(n);
        return g.columns == c && g.rows == r && g.multi_jittered == m;
    };
    REQUIRE((is(1, 1, 1, false) && is(2, 2, 1, false) && is(4, 2, 2, false) && is(12, 4, 3, false) && is(18, 6, 3, false)));
    REQUIRE((is(64, 8, 8, false) && is(100, 10, 10, false) && is(3, 1, 3, true) && is(5, 2, 3, true) && is(7, 2, 4, true)));
}

TEST_CASE("stratified puts one value into each stratum and one point into each cell", "[unit][samplers]") {
    for (const std::uint64_t n : {1u, 2u, 3u, 4u, 5u, 7u, 12u, 16u, 49u, 64u, 97u, 100u, 1024u})
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
            const Points one = draw<StratifiedSampler>("stratified", {.count = n, .seed = seed});
            for (std::size_t d = 0; d < 10; ++d) REQUIRE(one_per_stratum(one, d, n));
            const Points two = draw<StratifiedSampler>("stratified", {.count = n, .seed = seed, .arity = 2});
            const StratifiedGrid grid = StratifiedGrid::of(static_cast<std::uint32_t>(n));
            for (std::size_t d = 0; d < 10; d += 2) {
                if (!grid.multi_jittered) {
                    REQUIRE(one_per_cell(two, d, grid.columns, d + 1, grid.rows));
                    continue;
                }
                REQUIRE(one_per_stratum(two, d + 1, n));
                std::set<std::uint64_t> strata;  // of x: none is used twice
                for (std::size_t i = 0; i < n; ++i) strata.insert(two.bits24(d, i) * grid.columns * grid.rows >> 24);
                REQUIRE(strata.size() == n);
            }
        }
}

TEST_CASE("stratified is unbiased for a product of two slots and of the two numbers of one", "[unit][samplers]") {
    for (const std::uint64_t n : {4u, 5u, 7u, 16u}) {
        constexpr int kSeeds = 20000;
        double sum[3] = {}, square[3] = {};
        for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
            const Points p = draw<StratifiedSampler>("stratified", {.count = n, .seed = seed, .dimensions = 4, .arity = 2});
            double e[3] = {};
            for (std::size_t i = 0; i < n; ++i) {
                const double x = p(0, i) + 0x1p-25, y = p(1, i) + 0x1p-25, z = p(2, i) + 0x1p-25;
                e[0] += (x - 0.5) / static_cast<double>(n);
                e[1] += (x * x * z * z - 1.0 / 9.0) / static_cast<double>(n);
                e[2] += (x * x * y * y - 1.0 / 9.0) / static_cast<double>(n);
            }
            for (int k = 0; k < 3; ++k) sum[k] += e[k], square[k] += e[k] * e[k];
        }
        for (int k = 0; k < 3; ++k) REQUIRE(std::abs(sum[k]) < 5.0 * std::sqrt(square[k]));  // five standard errors
    }
}

TEST_CASE("A stratified index beyond the count is still a valid sample", "[unit][samplers]") {
    for (const std::uint64_t first : {100ull, (1ull << 32) + 5, ~0ull - 100}) {
        const Points p = draw<StratifiedSampler>("stratified", {.count = 50, .first = first, .arity = 2});
        for (const float x : p.values) REQUIRE((x >= 0 && x < 1));
    }
}

TEST_CASE("stratified:pixels=shared gives all pixels the same points, the default does not", "[unit][samplers]") {
    const auto at = [](const char* spec, Pixel p) { return draw<StratifiedSampler>(spec, {.count = 16, .pixel = p}).values; };
    REQUIRE(at("stratified:pixels=shared", {0, 0}) == at("stratified:pixels=shared", {7, 3}));
    REQUIRE(at("stratified", {0, 0}) != at("stratified", {7, 3}));
    REQUIRE(at("stratified", {3, 7}) != at("stratified", {7, 3}));
}
