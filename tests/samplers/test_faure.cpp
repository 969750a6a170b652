#include "draw.h"

#include <samplers/faure.h>

#include <koksma_catch.h>

#include <cmath>
#include <string>

using namespace koksma;
using namespace koksma::test;

namespace {

std::string spec(const char* randomize, std::uint32_t base) {
    return std::string("faure:randomize=") + randomize + ",base=" + std::to_string(base);
}

/// Whether one of the points lies in each elementary interval of the given numbers of cells a side.
bool one_per_box(const Points& p, std::span<const std::uint64_t> sides) {
    std::vector<int> hits(p.count, 0);
    for (std::size_t i = 0; i < p.count; ++i) {
        std::size_t box = 0;
        for (std::size_t d = 0; d < sides.size(); ++d) box = box * sides[d] + ((p.bits24(d, i) * sides[d]) >> 24);
        ++hits[box];
    }
    for (const int h : hits)
        if (h != 1) return false;
    return true;
}

/// Calls f with all ways to write base^m as a product of powers, one for each dimension.
template <class F>
void all_shapes(std::uint32_t base, int m, std::vector<std::uint64_t>& sides, std::size_t d, const F& f) {
    if (d + 1 == sides.size()) {
        sides[d] = 1;
        for (int k = 0; k < m; ++k) sides[d] *= base;
        f();
        return;
    }
    sides[d] = 1;
    for (int k = 0; k <= m; ++k, sides[d] *= base) {
        const std::uint64_t side = sides[d];
        all_shapes(base, m - k, sides, d + 1, f);
        sides[d] = side;
    }
}

}  // namespace

TEST_CASE("Unscrambled Faure points are the digits of powers of Pascal's matrix", "[unit][samplers]") {
    // Base 3, indices 1 .. 8, numerators over 9: dimension 0 mirrors the digits; dimension j adds j times the second to the first.
    constexpr int kNinths[8][3] = {{3, 3, 3}, {6, 6, 6}, {1, 4, 7}, {4, 7, 1}, {7, 1, 4}, {2, 8, 5}, {5, 2, 8}, {8, 5, 2}};
    const Points p = draw<FaureSampler>(spec("none", 3), {.count = 9, .dimensions = 3});
    for (std::size_t d = 0; d < 3; ++d) {
        REQUIRE(p(d, 0) == 0.0f);
        for (std::size_t i = 1; i <= 8; ++i) REQUIRE(p(d, i) == Approx(kNinths[i - 1][d] / 9.0).margin(0x1p-22).epsilon(0));
    }
}

TEST_CASE("Every aligned block of b^m Faure points is a (0, m, b)-net, however randomised", "[unit][samplers]") {
    for (const auto& [base, most] : {std::pair{3u, 6}, {5u, 4}, {7u, 3}, {11u, 2}, {13u, 2}})
        for (const char* randomize : {"none", "digits", "owen"}) {
            std::uint64_t n = 1;
            for (int m = 0; m <= most; ++m, n *= base)
                for (const std::uint64_t block : {0ull, 1ull, 6ull}) {
                    const Points p = draw<FaureSampler>(spec(randomize, base), {.count = n, .first = block * n, .seed = 2, .dimensions = base});
                    std::vector<std::uint64_t> sides(base);
                    bool holds = true;
                    all_shapes(base, m, sides, 0, [&] { holds = holds && one_per_box(p, sides); });
                    INFO(spec(randomize, base) << ", m = " << m << ", block " << block);
                    REQUIRE(holds);
                }
        }
}

TEST_CASE("Later sets of Faure dimensions are nets in orders of their own", "[unit][samplers]") {
    for (const char* randomize : {"none", "digits", "owen"}) {
        const Points p = draw<FaureSampler>(spec(randomize, 5), {.count = 125, .dimensions = 1500});
        for (std::size_t d = 0; d < 1500; ++d) REQUIRE(one_per_stratum(p, d, 125));
        for (std::size_t d = 5; d + 1 < 1500; d += 5) {
            REQUIRE((one_per_cell(p, d, 25, d + 1, 5) && one_per_cell(p, d + 2, 5, d + 4, 25)));
            std::size_t equal = 0;
            for (std::size_t i = 0; i < 125; ++i) equal += p(0, i) == p(d, i);
            REQUIRE(equal < 30);
        }
    }
}

TEST_CASE("Scrambled Faure points have the closed forms of their scrambling", "[unit][samplers]") {
    // Error of x: nested 1 / (12 N^3), digit places alike for all points 1 / (12 N^2), as of one random number in 1/N.
    constexpr int kSeeds = 600;
    for (const auto& [base, n] : {std::pair{3u, 243ull}, {5u, 125ull}, {7u, 343ull}, {13u, 169ull}})
        for (const char* randomize : {"digits", "owen"}) {
            const auto count = static_cast<double>(n);
            double square[6] = {};
            for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
                const Points p = draw<FaureSampler>(spec(randomize, base), {.count = n, .seed = seed, .dimensions = 6});
                for (std::size_t d = 0; d < 6; ++d) {
                    double mean = 0;
                    for (std::size_t i = 0; i < p.count; ++i) mean += (p(d, i) + 0x1p-25 - 0.5) / count;
                    square[d] += mean * mean / kSeeds;
                }
            }
            INFO(spec(randomize, base));
            for (const double v : square)
                REQUIRE(v * 12 * count * count * (randomize[0] == 'o' ? count : 1) == Approx(1).margin(6 * std::sqrt(2.0 / kSeeds)).epsilon(0));
        }
}

TEST_CASE("Faure indices beyond 2^32 are values like any other", "[unit][samplers]") {
    for (const std::uint32_t base : {3u, 5u, 7u, 11u, 13u})
        for (const char* randomize : {"none", "digits", "owen"}) {
            const Points near = draw<FaureSampler>(spec(randomize, base), {.count = 64, .dimensions = 100});
            for (const std::uint64_t first : {1ull << 32, 1ull << 52, ~0ull - 64}) {
                const Points far = draw<FaureSampler>(spec(randomize, base), {.count = 64, .first = first, .dimensions = 100});
                for (const float x : far.values) REQUIRE((x >= 0 && x < 1));
                REQUIRE(far.values != near.values);
            }
            // A block of b^2 far out is still a net.
            std::uint64_t block = (1ull << 40) / base / base * base * base;
            const Points p = draw<FaureSampler>(spec(randomize, base), {.count = base * base, .first = block, .dimensions = 3});
            for (std::size_t d = 0; d < 3; ++d) REQUIRE(one_per_stratum(p, d, base * base));
            REQUIRE(one_per_cell(p, 0, base, 2, base));
        }
}

TEST_CASE("A base that faure does not have is refused, and the good counts are those of the base", "[unit][samplers]") {
    Registry registry;
    registry.add<FaureSampler>();
    for (const char* bad : {"2", "4", "17", "", "5.0", "-3"}) REQUIRE_THROWS_AS(registry.make(std::string("faure:base=") + bad), Error);
    REQUIRE((registry.make("faure:base=7")->info().good_counts.contains(343) && !registry.make("faure:base=7")->info().good_counts.contains(25)));
    REQUIRE((registry.make("faure")->info().joint == 5 && registry.make("faure:base=11")->info().joint == 11));
}
