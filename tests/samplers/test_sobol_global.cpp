#include "film_draw.h"

#include <samplers/sobol_global.h>

#include <koksma_catch.h>

#include <cmath>
#include <string>
#include <unordered_set>

using namespace koksma;
using namespace koksma::test;

namespace {

std::uint32_t bits_of(std::uint64_t index, std::uint32_t dimension) { return reverse_bits(sobol_rev(sobol_matrices(), index, dimension)); }

}  // namespace

TEST_CASE("The closed forms of dimensions 0 and 1 are the Sobol' matrices", "[unit][samplers]") {
    for (std::uint64_t k = 0; k < 5000; ++k) {
        const std::uint64_t i = k < 1000 ? k : mix64(k);
        REQUIRE(static_cast<std::uint32_t>(i) == sobol_rev(sobol_matrices(), i, 0));
        REQUIRE(static_cast<std::uint32_t>(pascal_rev(i)) == sobol_rev(sobol_matrices(), i, 1));
        REQUIRE(pascal_rev(pascal_rev(i)) == i);
        REQUIRE(reverse_bits64(reverse_bits64(i)) == i);
    }
}

TEST_CASE("Sobol' indices of a pixel are those of the points that fall into it", "[unit][samplers]") {
    // All points of a grid by brute force, in the order of their indices; square, wide, high, and a single column.
    for (const auto& [w, h] : {std::pair{3, 3}, {5, 2}, {0, 4}, {4, 0}, {0, 0}, {1, 6}}) {
        const SobolEnumeration enumeration(w, h);
        std::vector<std::uint64_t> seen(std::size_t{1} << (w + h), 0);
        for (std::uint64_t index = 0; index < std::uint64_t{16} << (w + h); ++index) {
            const auto x = static_cast<std::int32_t>(std::uint64_t{bits_of(index, 0)} >> (32 - w));
            const auto y = static_cast<std::int32_t>(std::uint64_t{bits_of(index, 1)} >> (32 - h));
            std::uint64_t& n = seen[static_cast<std::size_t>((y << w) + x)];
            REQUIRE(enumeration.index({x, y}, n++) == index);
        }
    }
}

TEST_CASE("Sobol' indices of the largest film fit 64 bits and do not repeat", "[unit][samplers]") {
    const SobolEnumeration enumeration(16, 16);
    std::unordered_set<std::uint64_t> indices;
    std::size_t count = 0;
    for (const std::uint64_t n : {0ull, 1ull, 65535ull, 1ull << 20, (1ull << 31) + 5, (1ull << 32) - 1})
        for (std::int32_t x = 0; x < 65536; x += 4099)
            for (std::int32_t y = 3; y < 65536; y += 4111, ++count) {
                const std::uint64_t index = enumeration.index({x, y}, n);
                indices.insert(index);
                REQUIRE(index >> 32 == n);
                REQUIRE(reverse_bits64(index) >> 48 == static_cast<std::uint64_t>(x));
                REQUIRE(reverse_bits64(pascal_rev(index)) >> 48 == static_cast<std::uint64_t>(y));
            }
    REQUIRE(indices.size() == count);
}

TEST_CASE("sobol-global: the positions on the film and all other dimensions are one net over the image", "[unit][samplers]") {
    for (const char* randomize : {"none", "xor", "owen"}) {
        // 16 x 8 pixels of 8 samples: 2^10 points. The film position is pixel + value.
        const Points p = draw_film<SobolGlobalSampler>(std::string("sobol-global:randomize=") + randomize,
                                                       {.width = 16, .height = 8, .spp = 8, .seed = 3, .pairs = 3, .film_slot = true});
        Points film{p.count, std::vector<float>(2 * p.count)};
        for (std::size_t i = 0; i < p.count; ++i) {
            const std::size_t pixel = i / 8;
            film.values[i] = (static_cast<float>(pixel % 16) + p(0, i)) / 16;
            film.values[p.count + i] = (static_cast<float>(pixel / 16) + p(1, i)) / 8;
        }
        REQUIRE(is_net(film, 0, 0, 10));
        for (std::size_t d = 2; d < 6; ++d) REQUIRE(one_per_stratum(p, d, 1024));
    }
}

TEST_CASE("sobol-global: unscrambled points are those of the sequence, wherever the film slot is", "[unit][samplers]") {
    Registry registry;
    registry.add<SobolGlobalSampler>();
    const auto factory = registry.make("sobol-global:randomize=none");
    DimensionLayout layout;  // a bounce before the film slot, as in permuted layouts
    layout.add_camera(SlotRole::lens, 2);
    layout.add_camera(SlotRole::film, 2);
    layout.add_camera(SlotRole::time, 1);
    const SamplingPlan plan{.film_width = 30, .film_height = 20, .spp = 16, .layout = layout};
    const auto source = factory->bind(plan);
    const SobolEnumeration enumeration(5, 5);
    for (std::uint64_t n = 0; n < 16; ++n) {
        const Pixel pixel{static_cast<std::int32_t>(29 - n), static_cast<std::int32_t>(n)};
        const std::uint64_t index = enumeration.index(pixel, n);
        const SampleId id{pixel, n};
        float u[5];
        source->fill({&id, 1}, layout.slots(), u, 1);
        REQUIRE(u[0] == unit_float(bits_of(index, 2)));
        REQUIRE(u[1] == unit_float(bits_of(index, 3)));
        REQUIRE(u[2] == Approx(bits_of(index, 0) * 0x1p-27 - pixel.x).margin(1e-6));
        REQUIRE(u[3] == Approx(bits_of(index, 1) * 0x1p-27 - pixel.y).margin(1e-6));
        REQUIRE(u[4] == unit_float(bits_of(index, 4)));
    }
}

TEST_CASE("sobol-global: a film or a count beyond the limits is refused", "[unit][samplers]") {
    Registry registry;
    registry.add<SobolGlobalSampler>();
    const auto factory = registry.make("sobol-global");
    const SamplingPlan largest{.film_width = 65536, .film_height = 65536, .spp = 1ull << 32, .layout = film_layout(1, true)};
    REQUIRE_NOTHROW((void)factory->bind(largest));
    SamplingPlan plan = largest;
    plan.spp += 1;
    REQUIRE_THROWS_AS((void)factory->bind(plan), Error);
    plan = largest;
    plan.film_width += 1;
    REQUIRE_THROWS_AS((void)factory->bind(plan), Error);
    plan.film_width = 0;
    REQUIRE_THROWS_AS((void)factory->bind(plan), Error);
}
