#include "draw.h"

#include <samplers/kronecker.h>

#include <koksma_catch.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("Steps are the roots that Roberts defines, and odd", "[unit][samplers]") {
    const auto value = [](std::uint64_t step) { return std::ldexp(static_cast<double>(step), -64); };
    const double phi = 1 / value(kR1), g = 1 / value(kR2x);
    REQUIRE(phi * phi == Approx(phi + 1).epsilon(1e-14));
    REQUIRE(g * g * g == Approx(g + 1).epsilon(1e-14));
    REQUIRE(value(kR2y) == Approx(1 / (g * g)).epsilon(1e-14));
    REQUIRE((kR1 & kR2x & kR2y & 1) == 1);
}

TEST_CASE("The first slot, unrandomised, is the sequence of Roberts", "[unit][samplers]") {
    const Points one = draw<KroneckerSampler>("kronecker:randomize=none", {.count = 1000});
    const Points two = draw<KroneckerSampler>("kronecker:randomize=none", {.count = 1000, .arity = 2});
    for (std::size_t i = 0; i < 1000; ++i) {
        const auto at = [&](double a) { return std::fmod(0.5 + static_cast<double>(i) * a, 1.0); };
        REQUIRE(one(0, i) == Approx(at(0.6180339887498949)).margin(1e-7));
        REQUIRE(two(0, i) == Approx(at(0.7548776662466927)).margin(1e-7));
        REQUIRE(two(1, i) == Approx(at(0.5698402909980533)).margin(1e-7));
    }
    REQUIRE(one(0, 0) == 0.5f);
}

TEST_CASE("Products of step and index wrap exactly beyond 2^32", "[unit][samplers]") {
    for (const std::uint64_t step : {kR1, kR2x, kR2y})
        for (const std::uint64_t index : {1ull << 32, (1ull << 52) + 99, ~0ull}) {
            __extension__ typedef unsigned __int128 Wide;
            const auto exact = static_cast<std::uint64_t>(static_cast<Wide>(index) * step + (Wide{1} << 63));
            REQUIRE(kronecker_bits(index, step) == exact >> 32);
        }
    for (const std::uint64_t first : {1ull << 32, 1ull << 52, ~0ull - 64})
        for (const float x : draw<KroneckerSampler>("kronecker", {.count = 64, .first = first, .dimensions = 2000}).values) REQUIRE((x >= 0 && x < 1));
}

TEST_CASE("Gaps between the first 2^m values have at most three lengths, in every slot", "[unit][samplers]") {
    // The three-gap theorem (Sos 1958), which shift and shuffle leave alone; lengths to within the 24 bits of a float.
    for (const char* spec : {"kronecker:randomize=none", "kronecker:randomize=cp"})
        for (const std::uint64_t n : {16ull, 256ull, 4096ull}) {
            const Points p = draw<KroneckerSampler>(spec, {.count = n, .seed = 3, .arity = 2});
            for (std::size_t d = 0; d < 10; ++d) {
                std::vector<std::uint64_t> values(n);
                for (std::size_t i = 0; i < n; ++i) values[i] = p.bits24(d, i);
                std::sort(values.begin(), values.end());
                std::vector<std::uint64_t> gaps;
                for (std::size_t i = 0; i < n; ++i) gaps.push_back((i + 1 < n ? values[i + 1] : values[0] + (1u << 24)) - values[i]);
                std::sort(gaps.begin(), gaps.end());
                int lengths = 1;
                for (std::size_t i = 1; i < n; ++i) lengths += gaps[i] > gaps[i - 1] + 1;
                REQUIRE(lengths <= 3);
            }
        }
}

TEST_CASE("Slots of kronecker are in orders of their own", "[unit][samplers]") {
    for (const char* spec : {"kronecker:randomize=none", "kronecker:randomize=cp"}) {
        const Points p = draw<KroneckerSampler>(spec, {.count = 256, .dimensions = 64, .arity = 2});
        for (std::size_t a = 0; a < 64; a += 2)
            for (std::size_t b = a + 2; b < 64; b += 2) {
                std::set<std::uint64_t> differences;  // a copy, shifted or not, has one (two of rounding); two nested orders 89 +- 14
                for (std::size_t i = 0; i < p.count; ++i) differences.insert((p.bits24(a, i) - p.bits24(b, i)) & 0xffffffu);
                REQUIRE(differences.size() > 8);
            }
    }
}
