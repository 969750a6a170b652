#include "film_draw.h"

#include <samplers/halton_global.h>

#include <koksma_catch.h>

#include <unordered_set>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("Halton indices of a pixel are those of the points that fall into it", "[unit][samplers]") {
    for (const auto& [width, height] : {std::pair{8u, 9u}, {7u, 5u}, {1u, 20u}, {20u, 1u}, {1u, 1u}}) {
        const HaltonEnumeration enumeration(width, height);
        std::uint64_t columns = 1, rows = 1;
        while (columns < width) columns *= 2;
        while (rows < height) rows *= 3;
        REQUIRE(enumeration.stride() == columns * rows);
        std::vector<std::uint64_t> seen(columns * rows, 0);
        for (std::uint64_t index = 0; index < 6 * columns * rows; ++index) {
            // Digits in integers: mirrored(index) / base^k is the position.
            std::uint64_t x = 0, y = 0, n = index;
            for (std::uint64_t c = columns; c > 1; c /= 2, n /= 2) x = 2 * x + n % 2;
            REQUIRE(enumeration.column_index(index) == n);
            n = index;
            for (std::uint64_t r = rows; r > 1; r /= 3, n /= 3) y = 3 * y + n % 3;
            REQUIRE(enumeration.row_index(index) == n);
            REQUIRE(enumeration.index({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}, seen[y * columns + x]++) == index);
        }
    }
}

TEST_CASE("Halton indices of the largest film fit 64 bits and do not repeat", "[unit][samplers]") {
    const HaltonEnumeration enumeration(65536, 65536);
    REQUIRE(enumeration.stride() == 65536ull * 177147);
    std::unordered_set<std::uint64_t> indices;
    std::size_t count = 0;
    for (const std::uint64_t n : {0ull, 1ull, 69043ull, 1ull << 24, (1ull << 30) - 1})
        for (std::int32_t x = 0; x < 65536; x += 4099)
            for (std::int32_t y = 3; y < 65536; y += 4111, ++count) {
                const std::uint64_t index = enumeration.index({x, y}, n);
                indices.insert(index);
                REQUIRE(index / enumeration.stride() == n);  // no overflow
                std::uint64_t row = 0, m = index;
                for (int k = 0; k < 11; ++k, m /= 3) row = 3 * row + m % 3;
                REQUIRE(row == static_cast<std::uint64_t>(y));
                REQUIRE(reverse_bits(static_cast<std::uint32_t>(index)) >> 16 == static_cast<std::uint32_t>(x));
            }
    REQUIRE(indices.size() == count);
}

TEST_CASE("halton-global: the positions on the film and all other dimensions are stratified over the image", "[unit][samplers]") {
    for (const char* spec : {"halton-global:randomize=none", "halton-global:randomize=digits", "halton-global:randomize=owen"}) {
        // 8 x 9 pixels of 6 samples: 432 = 2^4 3^3 points.
        const Points p = draw_film<HaltonGlobalSampler>(spec, {.width = 8, .height = 9, .spp = 6, .seed = 3, .pairs = 3, .film_slot = true});
        // Within a pixel, 2 x 3 cells have a point each.
        for (std::size_t pixel = 0; pixel < 72; ++pixel) {
            int hits[2][3] = {};
            for (std::size_t i = 6 * pixel; i < 6 * pixel + 6; ++i) ++hits[static_cast<int>(2 * p(0, i))][static_cast<int>(3 * p(1, i))];
            for (const auto& column : hits)
                for (const int h : column) REQUIRE(h == 1);
        }
        // Base 5: every 125 consecutive samples of one pixel fill 125 strata, since the stride has no factor 5.
        const Points q = draw_film<HaltonGlobalSampler>(spec, {.width = 8, .height = 9, .spp = 125, .seed = 4, .first = 250, .pairs = 3, .film_slot = true, .x0 = 5, .y0 = 7, .columns = 1, .rows = 1});
        REQUIRE(one_per_stratum(q, 2, 125));
    }
}

TEST_CASE("halton-global: unscrambled points are those of the sequence", "[unit][samplers]") {
    const Points p = draw_film<HaltonGlobalSampler>("halton-global:randomize=none", {.width = 30, .height = 20, .spp = 4, .pairs = 2, .film_slot = true});
    const HaltonEnumeration enumeration(30, 20);
    const HaltonBase* bases = halton_bases();
    for (std::size_t i = 0; i < p.count; ++i) {
        const std::size_t pixel = i / 4, x = pixel % 30, y = pixel / 30;
        const std::uint64_t index = enumeration.index({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}, i % 4);
        REQUIRE(p(0, i) == Approx(32.0 * radical_inverse(bases[0], index) - static_cast<double>(x)).margin(1e-5));
        REQUIRE(p(1, i) == Approx(27.0 * radical_inverse(bases[1], index) - static_cast<double>(y)).margin(1e-5));
        REQUIRE(p(2, i) == radical_inverse(bases[2], index));
        REQUIRE(p(3, i) == radical_inverse(bases[3], index));
    }
}

TEST_CASE("halton-global: a film or a count beyond the limits is refused", "[unit][samplers]") {
    Registry registry;
    registry.add<HaltonGlobalSampler>();
    const auto factory = registry.make("halton-global");
    SamplingPlan plan{.film_width = 65536, .film_height = 65536, .spp = 1ull << 30, .layout = film_layout(1, true)};
    REQUIRE_NOTHROW((void)factory->bind(plan));
    plan.spp += 1;
    REQUIRE_THROWS_AS((void)factory->bind(plan), Error);
    plan.spp = 1;
    plan.film_height += 1;
    REQUIRE_THROWS_AS((void)factory->bind(plan), Error);
}
