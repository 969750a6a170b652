#include "draw.h"

#include <samplers/sobol.h>

#include <koksma_catch.h>

#include <cmath>

using namespace koksma;
using namespace koksma::test;

namespace {

std::uint32_t sobol_bits(std::uint64_t index, std::uint32_t dimension) {
    return reverse_bits(sobol_rev(sobol_matrices(), index, dimension));
}

/// Quality parameter t of the first 2^m points in two dimensions: the least t for which every elementary interval of
/// volume 2^(t-m) holds 2^t points. Counted on the points themselves.
int pair_t(const Points& p, std::size_t d0, std::size_t d1, int m) {
    for (int t = 0; t <= m; ++t) {
        bool holds = true;
        for (int k = 0; holds && k <= m - t; ++k) {
            std::vector<int> hits(std::size_t{1} << (m - t), 0);
            for (std::size_t i = 0; i < p.count; ++i)
                ++hits[((p.bits24(d0, i) >> (24 - k)) << (m - t - k)) | (p.bits24(d1, i) >> (24 - (m - t - k)))];
            for (const int h : hits) holds = holds && h == 1 << t;
        }
        if (holds) return t;
    }
    return m;
}

}  // namespace

TEST_CASE("Direction numbers of the first 1024 dimensions are those of Joe and Kuo", "[unit][samplers]") {
    // The xor of 1024 x 32 numbers, computed independently of this code (and equal to SciPy's table).
    std::uint32_t all = 0;
    for (std::uint32_t d = 0; d < 1024; ++d)
        for (std::uint32_t c = 0; c < 32; ++c) all ^= sobol_direction(d, c);
    REQUIRE(all == 0xa87c0586u);
}

TEST_CASE("Every matrix is upper triangular with a full diagonal, so every dimension is stratified", "[unit][samplers]") {
    for (std::uint32_t d = 0; d < kSobolDimensions; ++d) {
        bool ok = true;
        for (std::uint32_t c = 0; c < 32; ++c) {
            const std::uint32_t v = sobol_direction(d, c);
            ok = ok && (v >> (31 - c) & 1u) == 1u && (c == 31 || (v << (c + 1)) == 0u);
        }
        REQUIRE(ok);
    }
}

TEST_CASE("Unscrambled Sobol' points are bit-exact", "[unit][samplers]") {
    // Direct binary order; from an independent implementation of the same table, equal to SciPy's points bit for bit.
    constexpr std::uint32_t kFirst[8][5] = {{0, 0, 0, 0, 0},
                                            {0x80000000, 0x80000000, 0x80000000, 0x80000000, 0x80000000},
                                            {0x40000000, 0xc0000000, 0xc0000000, 0xc0000000, 0x40000000},
                                            {0xc0000000, 0x40000000, 0x40000000, 0x40000000, 0xc0000000},
                                            {0x20000000, 0xa0000000, 0x60000000, 0x20000000, 0x20000000},
                                            {0xa0000000, 0x20000000, 0xe0000000, 0xa0000000, 0xa0000000},
                                            {0x60000000, 0x60000000, 0xa0000000, 0xe0000000, 0x60000000},
                                            {0xe0000000, 0xe0000000, 0x20000000, 0x60000000, 0xe0000000}};
    constexpr std::uint32_t k1023[8] = {0xffc00000, 0x41400000, 0xbb400000, 0x70c00000, 0xe6400000, 0x41c00000, 0xbc400000, 0x4bc00000};
    constexpr std::uint32_t kABCDE[8] = {0x7b3d5000, 0x96eb3000, 0x61015000, 0xedaf7000, 0x055c1000, 0xac077000, 0x8e481000, 0xb42dd000};
    const Points p = draw<SobolSampler>("sobol:randomize=none", {.count = 1024});
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t d = 0; d < 5; ++d) {
            REQUIRE(sobol_bits(i, d) == kFirst[i][d]);
            REQUIRE(p(d, i) == unit_float(kFirst[i][d]));
        }
    for (std::uint32_t d = 0; d < 8; ++d) {
        REQUIRE(sobol_bits(1023, d) == k1023[d]);
        REQUIRE(sobol_bits(0xABCDE, d) == kABCDE[d]);
    }
}

TEST_CASE("A point is the xor of the columns that its index selects, for 64-bit indices too", "[unit][samplers]") {
    for (const std::uint64_t index : {1ull << 32, (1ull << 40) + 12345, (1ull << 52) - 1, 0xfedcba9876543210ull, ~0ull})
        for (const std::uint32_t d : {0u, 1u, 2u, 63u, 1024u, 4095u}) {
            std::uint32_t x = 0;
            for (std::uint32_t c = 0; c < 64; ++c)
                if ((index >> c) & 1u) x ^= sobol_direction(d, c);
            REQUIRE(sobol_bits(index, d) == x);
        }
    REQUIRE(sobol_bits(1ull << 32, 0) == 0u);  // the digit of 2^-33
    REQUIRE(sobol_bits(1ull << 32, 1) != 0u);
    const Points p = draw<SobolSampler>("sobol", {.count = 64, .first = 1ull << 40, .dimensions = 4096});
    for (const float x : p.values) REQUIRE((x >= 0 && x < 1));
}

TEST_CASE("The t-values of pairs are those of the table, scrambled or not", "[unit][samplers]") {
    // m = 4, 6, 8, 10 of all pairs of the first 10 dimensions: (0,1), (0,2) .. (8,9); computed independently. t is not
    // monotone in m, and no randomisation of digits changes it: equality.
    constexpr int kT[45][4] = {
        {0, 0, 0, 0}, {0, 1, 1, 1}, {2, 1, 1, 2}, {1, 2, 1, 2}, {3, 2, 3, 2}, {1, 1, 1, 1}, {1, 1, 3, 0}, {1, 1, 2, 4}, {1, 2, 2, 1},
        {1, 1, 1, 1}, {1, 0, 2, 1}, {1, 0, 2, 1}, {0, 2, 0, 2}, {3, 1, 3, 2}, {2, 4, 2, 3}, {2, 3, 1, 2}, {0, 1, 2, 1}, {0, 1, 1, 1},
        {2, 3, 1, 2}, {1, 2, 1, 2}, {1, 0, 2, 2}, {1, 1, 1, 2}, {1, 3, 4, 2}, {2, 0, 2, 2}, {2, 1, 1, 3}, {0, 2, 2, 3}, {1, 2, 2, 1},
        {1, 1, 3, 2}, {1, 2, 4, 2}, {1, 1, 1, 3}, {0, 1, 3, 1}, {0, 2, 2, 1}, {1, 2, 3, 1}, {1, 3, 1, 2}, {1, 1, 2, 1}, {1, 1, 2, 2},
        {1, 0, 2, 1}, {1, 1, 2, 3}, {1, 3, 1, 2}, {2, 1, 2, 1}, {2, 1, 3, 1}, {0, 1, 2, 2}, {3, 1, 2, 2}, {0, 2, 3, 2}, {0, 1, 2, 3},
    };
    for (const char* spec : {"sobol:randomize=none", "sobol:randomize=xor", "sobol:randomize=owen", "sobol:randomize=owen-exact"})
        for (int k = 0; k < 4; ++k) {
            const int m = 4 + 2 * k;
            const Points p = draw<SobolSampler>(spec, {.count = 1ull << m, .seed = 11});
            std::size_t pair = 0;
            for (std::size_t a = 0; a < 10; ++a)
                for (std::size_t b = a + 1; b < 10; ++b, ++pair) REQUIRE(pair_t(p, a, b, m) == kT[pair][k]);
        }
}

TEST_CASE("Every aligned block of the first two dimensions is a (0, m, 2)-net, and every dimension is stratified", "[unit][samplers]") {
    for (const char* spec : {"sobol:randomize=none", "sobol:randomize=xor", "sobol:randomize=owen", "sobol:randomize=owen-exact"})
        for (int m = 0; m <= 12; ++m)
            for (const std::uint64_t block : {0ull, 3ull, 1ull << 30}) {
                const Points p = draw<SobolSampler>(spec, {.count = 1ull << m, .first = block << m, .seed = 5, .arity = 2});
                REQUIRE(pair_t(p, 0, 1, m) == 0);
                for (std::size_t d = 0; d < 10; ++d) REQUIRE(one_per_stratum(p, d, p.count));
            }
}

TEST_CASE("The hash scrambles as the tree does: variances of nested scrambling", "[unit][samplers]") {
    // N = 256. Mean of x: 1 / (12 N^3). Mean of (x - 1/2)(y - 1/2) over a (0, m, 2)-net: (28 m / 3 + 16 / 9) / (256 N^3),
    // from the gain coefficients 0, 2, 1 of such a net (Owen 1997) and the Haar variances 4^-k / 16 of x - 1/2.
    constexpr int kSeeds = 400, kM = 8;
    constexpr double kN = 1 << kM;
    for (const char* spec : {"sobol:randomize=owen", "sobol:randomize=owen-exact"}) {
        double linear[10] = {}, bilinear = 0;
        for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
            const Points p = draw<SobolSampler>(spec, {.count = 1 << kM, .seed = seed});
            double e[10] = {}, product = 0;
            for (std::size_t i = 0; i < p.count; ++i) {
                for (std::size_t d = 0; d < 10; ++d) e[d] += (p(d, i) + 0x1p-25 - 0.5) / kN;
                product += (p(0, i) + 0x1p-25 - 0.5) * (p(1, i) + 0x1p-25 - 0.5) / kN;
            }
            for (std::size_t d = 0; d < 10; ++d) linear[d] += e[d] * e[d] / kSeeds;
            bilinear += product * product / kSeeds;
        }
        const double margin = 6 * std::sqrt(2.0 / kSeeds);
        for (const double v : linear) REQUIRE(v * 12 * kN * kN * kN == Approx(1).margin(margin).epsilon(0));
        REQUIRE(bilinear * 256 * kN * kN * kN / (28.0 * kM / 3 + 16.0 / 9) == Approx(1).margin(1.3 * margin).epsilon(0));
    }
}

TEST_CASE("The hash changes a bit only by the bits above it", "[unit][samplers]") {
    for (std::uint32_t k = 0; k < 2000; ++k) {
        const std::uint32_t x = keyed_hash({1, 2}, k), seed = keyed_hash({3, 4}, k);
        for (int bit = 0; bit < 32; ++bit) {
            const std::uint32_t change = owen_hash_rev(x, seed) ^ owen_hash_rev(x ^ (1u << bit), seed);
            const std::uint32_t change_tree = owen_tree(reverse_bits(x), {seed, k}) ^ owen_tree(reverse_bits(x ^ (1u << bit)), {seed, k});
            REQUIRE((change & ((2u << bit) - 1u)) == 1u << bit);
            REQUIRE((reverse_bits(change_tree) & ((2u << bit) - 1u)) == 1u << bit);
        }
    }
}
