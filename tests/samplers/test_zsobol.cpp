#include "film_draw.h"

#include <samplers/zsobol.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("Z order takes blocks of four pixels together at every level", "[unit][samplers]") {
    REQUIRE(morton(0, 0) == 0);
    REQUIRE(morton(1, 0) == 1);
    REQUIRE(morton(0, 1) == 2);
    REQUIRE(morton(0xffff, 0) == 0x55555555u);
    REQUIRE(morton(0xffff, 0xffff) == 0xffffffffu);
    for (std::uint32_t x = 0; x < 64; ++x)
        for (std::uint32_t y = 0; y < 64; ++y) REQUIRE(morton(x, y) >> 2 == morton(x / 2, y / 2));
}

TEST_CASE("The permutation of base-4 digits is a nested bijection", "[unit][samplers]") {
    for (int bits = 0; bits <= 12; ++bits)
        for (const std::uint64_t key : {0ull, 1ull, 77ull}) {
            std::set<std::uint64_t> images;
            for (std::uint64_t n = 0; n < 1ull << bits; ++n) {
                const std::uint64_t image = permute_digits4(n, bits, key);
                REQUIRE(image < 1ull << bits);
                images.insert(image);
                if (bits >= 2) {  // digits above do not depend on those below
                    const int low = bits % 2 == 0 ? 2 : 1;
                    REQUIRE(image >> low == permute_digits4(n >> low << low, bits, key) >> low);
                }
            }
            REQUIRE(images.size() == 1ull << bits);
        }
    REQUIRE(permute_digits4(~0ull, 64, 5) != permute_digits4(~0ull - 1, 64, 5));
}

TEST_CASE("All 24 permutations of a digit are equally likely", "[unit][samplers]") {
    std::vector<int> hits(256, 0);
    constexpr int kKeys = 24000;
    for (std::uint64_t key = 0; key < kKeys; ++key) {
        std::size_t all = 0;
        for (std::uint64_t n = 0; n < 4; ++n) all = all * 4 + permute_digits4(n, 2, mix64(key + 1));
        ++hits[all];
    }
    int kinds = 0;
    for (const int h : hits) {
        kinds += h > 0;
        REQUIRE((h == 0 || std::abs(h - 1000) < 6 * 32));
    }
    REQUIRE(kinds == 24);
}

TEST_CASE("zsobol: the samples of every pixel, and of every aligned block of pixels, are a net", "[unit][samplers]") {
    for (const char* spec : {"zsobol:randomize=xor", "zsobol:randomize=owen"})
        for (const int m : {0, 1, 2, 3, 4, 5, 8}) {
            const Points p = draw_film<ZSobolSampler>(spec, {.width = 4, .height = 4, .spp = 1ull << m, .seed = 9});
            for (std::size_t d = 0; d < 4; d += 2) {
                for (std::size_t pixel = 0; pixel < 16; ++pixel) REQUIRE(is_net(p, d, pixel << m, m));
                REQUIRE(is_net(p, d, 0, m + 4));
            }
            // The block of pixels (2, 2) to (3, 3).
            const Points q = draw_film<ZSobolSampler>(spec, {.width = 4, .height = 4, .spp = 1ull << m, .seed = 9, .x0 = 2, .y0 = 2, .columns = 2, .rows = 2});
            REQUIRE(is_net(q, 0, 0, m + 2));
        }
}

TEST_CASE("zsobol: a count between powers of two takes the first samples of the next", "[unit][samplers]") {
    const Points all = draw_film<ZSobolSampler>("zsobol", {.width = 4, .height = 4, .spp = 16, .seed = 2});
    const Points some = draw_film<ZSobolSampler>("zsobol", {.width = 4, .height = 4, .spp = 11, .seed = 2});
    for (std::size_t pixel = 0; pixel < 16; ++pixel)
        for (std::size_t i = 0; i < 11; ++i) REQUIRE(some(1, pixel * 11 + i) == all(1, pixel * 16 + i));
}

TEST_CASE("zsobol: another seed is another order of the pixels", "[unit][samplers]") {
    // At one sample a pixel, which of four pixels has the smallest value is the order.
    std::set<int> orders;
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        const Points p = draw_film<ZSobolSampler>("zsobol:randomize=xor", {.width = 2, .height = 2, .seed = seed, .pairs = 1});
        int order = 0;
        for (std::size_t i = 0; i < 4; ++i) order = order * 4 + static_cast<int>(4 * p(0, i));
        orders.insert(order);
    }
    REQUIRE(orders.size() > 16);  // xor alone makes 4
}

TEST_CASE("zsobol: per pixel as padded Owen-scrambled Sobol', smaller over blocks of pixels", "[unit][samplers]") {
    // Closed form of a (0, m, 2)-net: variance of (x - 1/2)(y - 1/2) is (28 m / 3 + 16 / 9) / (256 N^3). The mean over 2 x 2
    // aligned pixels is a net of 4 N points: its variance is that of N, divided by 64 or so and not by 4.
    constexpr int kM = 4, kSeeds = 1500;
    const auto closed = [](double m, double n) { return (28 * m / 3 + 16.0 / 9) / (256 * n * n * n); };
    double pixel = 0, block = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Points p = draw_film<ZSobolSampler>("zsobol", {.width = 2, .height = 2, .spp = 1 << kM, .seed = seed, .pairs = 1});
        double e[4] = {}, sum = 0;
        for (std::size_t i = 0; i < p.count; ++i) e[i >> kM] += (p(0, i) + 0x1p-25 - 0.5) * (p(1, i) + 0x1p-25 - 0.5) / (1 << kM);
        for (const double v : e) sum += v / 4;
        pixel += e[0] * e[0] / kSeeds;
        block += sum * sum / kSeeds;
    }
    const double margin = 6 * 1.3 * std::sqrt(2.0 / kSeeds);
    REQUIRE(pixel / closed(kM, 1 << kM) == Approx(1).margin(margin).epsilon(0));
    REQUIRE(block / closed(kM + 2, 4 << kM) == Approx(1).margin(margin).epsilon(0));
}

TEST_CASE("zsobol: films beyond the limit are refused", "[unit][samplers]") {
    Registry registry;
    registry.add<ZSobolSampler>();
    SamplingPlan plan{.film_width = 65536, .film_height = 65536, .spp = 1ull << 32, .layout = film_layout(1, false)};
    REQUIRE_NOTHROW((void)registry.make("zsobol")->bind(plan));
    plan.film_width = 65537;
    REQUIRE_THROWS_AS((void)registry.make("zsobol")->bind(plan), Error);
}
