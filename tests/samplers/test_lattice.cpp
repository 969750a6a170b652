#include "draw.h"

#include <samplers/lattice.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("Unshifted lattice points are multiples of the generating vector", "[unit][samplers]") {
    const std::uint32_t* z = lattice_vector();
    REQUIRE(z[0] == 1);
    for (std::uint32_t d = 0; d < kLatticeDimensions; ++d) REQUIRE((z[d] % 2 == 1 && z[d] < kLatticePoints));
    // The first 2^m points are k z / 2^m modulo 1, k = 0 .. 2^m - 1, in the order of the radical inverse.
    for (const int m : {3, 10, 18}) {
        const std::uint64_t n = 1ull << m;
        const Points p = draw<LatticeSampler>("lattice:randomize=none", {.count = n, .dimensions = 64});
        for (std::uint64_t i = 0; i < n; i += 1 + n / 300)
            for (std::size_t d = 0; d < 64; ++d) {
                const std::uint64_t k = reverse_bits(static_cast<std::uint32_t>(i)) >> (32 - m);
                REQUIRE(p.bits24(d, i) == (((k * z[d]) % n) << (24 - m)));
            }
    }
}

TEST_CASE("No two dimensions of the generating vector are equal or opposite", "[unit][samplers]") {
    std::set<std::uint32_t> seen;
    for (std::uint32_t d = 0; d < kLatticeDimensions; ++d) {
        REQUIRE(seen.insert(lattice_vector()[d]).second);
        REQUIRE(seen.insert(static_cast<std::uint32_t>(kLatticePoints) - lattice_vector()[d]).second);
    }
}

TEST_CASE("A shifted lattice has one value in each stratum, in every aligned block", "[unit][samplers]") {
    for (const char* spec : {"lattice:randomize=none", "lattice:randomize=cp"})
        for (std::uint64_t seed = 0; seed < 4; ++seed)
            for (const std::uint64_t n : {1ull, 16ull, 256ull, 4096ull})
                for (const std::uint64_t block : {0ull, 1ull, 7ull}) {
                    const Points p = draw<LatticeSampler>(spec, {.count = n, .first = block * n, .seed = seed, .dimensions = 64});
                    for (std::size_t d = 0; d < 64; ++d) REQUIRE(one_per_stratum(p, d, n));
                }
}

TEST_CASE("The tent is exact, and below one", "[unit][samplers]") {
    REQUIRE((tent(0) == 0 && tent(1) == 2 && tent(0x40000000u) == 0x80000000u && tent(0xc0000000u) == 0x80000000u));
    REQUIRE((tent(0x80000000u) == 0xffffffffu && tent(0x80000001u) == 0xfffffffeu && tent(0x7fffffffu) == 0xfffffffeu && tent(0xffffffffu) == 2));
    REQUIRE(unit_float(tent(0x80000000u)) == kOneMinusUlp);
}

TEST_CASE("The tent comes after the shift, and points stay distinct without a random one", "[unit][samplers]") {
    const Points plain = draw<LatticeSampler>("lattice:randomize=cp", {.count = 64, .seed = 9});
    const Points folded = draw<LatticeSampler>("lattice:randomize=cp,tent=on", {.count = 64, .seed = 9});
    for (std::size_t k = 0; k < plain.values.size(); ++k)
        REQUIRE(std::abs(folded.values[k] - (1 - std::abs(2 * plain.values[k] - 1))) <= 0x1p-22f);
    const Points fixed = draw<LatticeSampler>("lattice:randomize=none,tent=on", {.count = 1024});
    std::set<float> values;
    for (std::size_t i = 0; i < 1024; ++i) values.insert(fixed(3, i));
    REQUIRE(values.size() == 1024);
}

TEST_CASE("A shifted lattice has the variance of a shifted grid in each dimension", "[unit][samplers]") {
    // Error of x: that of one uniform number in an interval 1/N, variance 1 / (12 N^2), kurtosis 1.8.
    constexpr int kSeeds = 1000;
    for (const double n : {64.0, 1024.0}) {
        double square[8] = {};
        for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
            const Points p = draw<LatticeSampler>("lattice", {.count = static_cast<std::uint64_t>(n), .seed = seed, .dimensions = 8});
            for (std::size_t d = 0; d < 8; ++d) {
                double mean = 0;
                for (std::size_t i = 0; i < p.count; ++i) mean += (p(d, i) + 0x1p-25 - 0.5) / n;
                square[d] += mean * mean / kSeeds;
            }
        }
        for (const double v : square) REQUIRE(v * 12 * n * n == Approx(1).margin(6 * std::sqrt(0.8 / kSeeds)).epsilon(0));
    }
}

TEST_CASE("The lattice refuses what its vector was not made for", "[unit][samplers]") {
    REQUIRE_NOTHROW(draw<LatticeSampler>("lattice", {.count = 1u << 18, .dimensions = 1}));
    REQUIRE_THROWS_AS(draw<LatticeSampler>("lattice", {.count = (1u << 18) + 1, .dimensions = 1}), Error);
    const Points p = draw<LatticeSampler>("lattice", {.count = 2, .dimensions = 258});
    REQUIRE(p(256, 1) == tail_sample(0, {{}, 1}, 256, SlotRole::direction, 0));
}
