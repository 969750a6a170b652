// sobol-padded and sobol-4d: sets of dimensions of the Sobol' sequence, each in an order of its own.

#include "draw.h"

#include <samplers/sobol.h>
#include <samplers/sobol_4d.h>
#include <samplers/sobol_padded.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>

using namespace koksma;
using namespace koksma::test;

namespace {

/// The slots of a path: camera (film, lens, time), then bounces of (light choice, light position, lobe, direction, roulette).
DimensionLayout path_layout() {
    DimensionLayout layout;
    layout.add_camera(SlotRole::film, 2);
    layout.add_camera(SlotRole::lens, 2);
    layout.add_camera(SlotRole::time, 1);
    for (int b = 0; b < 3; ++b) {
        layout.begin_bounce();
        layout.add_bounce(SlotRole::light_choice, 1);
        layout.add_bounce(SlotRole::light_position, 2);
        layout.add_bounce(SlotRole::lobe, 1);
        layout.add_bounce(SlotRole::direction, 2);
        layout.add_bounce(SlotRole::roulette, 1);
    }
    return layout;
}

template <class S>
Points draw_layout(const DimensionLayout& layout, std::uint64_t count, std::uint64_t seed, std::uint64_t first = 0) {
    Registry registry;
    registry.add<S>();
    const auto source = registry.make(S::info().name)->bind({.spp = count, .seed = seed, .layout = layout});
    std::vector<SampleId> ids(count);
    for (std::uint64_t i = 0; i < count; ++i) ids[i] = {{}, first + i};
    Points points{count, std::vector<float>(std::size_t{layout.dimensions()} * count)};
    source->fill(ids, layout.slots(), points.values.data(), count);
    return points;
}

bool is_net(const Points& p, std::size_t d0, std::size_t d1) {
    for (std::uint64_t n = 1; n <= p.count; n *= 2)
        if (!one_per_cell(p, d0, n, d1, p.count / n)) return false;
    return true;
}

}  // namespace

TEST_CASE("The short table and the closed form are the first four dimensions of Sobol'", "[unit][samplers]") {
    const SobolNibble* matrices = sobol_matrices();
    for (const std::uint64_t index :
         {0ull, 1ull, 2ull, 12345ull, 0xabcdeull, (1ull << 32) - 1, 1ull << 32, (1ull << 40) + 777, 0xfedcba9876543210ull, ~0ull})
        for (std::uint32_t d = 0; d < 4; ++d) {
            REQUIRE(sobol4_rev(index, d) == sobol_rev(matrices, index, d));
            if (d == 1) REQUIRE(static_cast<std::uint32_t>(pascal_rev(index)) == sobol_rev(matrices, index, d));
        }
}

TEST_CASE("The shuffle is a permutation that keeps aligned blocks, beyond 2^32 too", "[unit][samplers]") {
    for (std::uint32_t counter = 0; counter < 50; ++counter)
        for (const std::uint64_t first : {0ull, 1ull << 31, 1ull << 32, (1ull << 40) + (5ull << 10)}) {
            const Key key = pixel_key(counter, {1, 2});
            std::set<std::uint64_t> images, blocks;
            for (std::uint64_t i = first; i < first + 1024; ++i) {
                const std::uint64_t image = shuffled_index(i, key, counter);
                images.insert(image);
                blocks.insert(image >> 10);
                REQUIRE(image >> 32 == i >> 32);
            }
            REQUIRE((images.size() == 1024 && blocks.size() == 1));
        }
}

TEST_CASE("Sets of dimensions follow the groups of the layout, pairs first", "[unit][samplers]") {
    const std::vector<JointPlace> places = joint_sets(path_layout(), 4, true);
    const auto is = [&](std::size_t d, std::uint32_t set, std::uint32_t within) { return places[d].set == set && places[d].within == within; };
    REQUIRE((is(0, 0, 0) && is(1, 0, 1) && is(2, 0, 2) && is(3, 0, 3) && is(4, 4, 0)));          // film, lens; time
    REQUIRE((is(5, 5, 2) && is(6, 5, 0) && is(7, 5, 1) && is(8, 5, 3)));                         // choice, position, lobe
    REQUIRE((is(9, 9, 0) && is(10, 9, 1) && is(11, 9, 2) && is(12, 12, 2) && is(13, 12, 0)));    // direction, roulette; next bounce
    const std::vector<JointPlace> across = joint_sets(path_layout(), 7, false);
    REQUIRE((across[0].set == 0 && across[5].set == 0 && across[6].set == 6 && across[12].set == 6 && across[13].set == 13));
}

TEST_CASE("Every slot of sobol-padded and sobol-4d is a (0, m, 2)-net in every aligned block", "[unit][samplers]") {
    const DimensionLayout layout = path_layout();
    for (const std::uint64_t first : {0ull, 3ull << 10, 1ull << 32, (1ull << 45) + (1ull << 10)})
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const Points padded = draw_layout<SobolPaddedSampler>(layout, 1024, seed, first);
            const Points four = draw_layout<Sobol4DSampler>(layout, 1024, seed, first);
            for (std::size_t d = 0; d < layout.dimensions(); ++d) REQUIRE((one_per_stratum(padded, d, 1024) && one_per_stratum(four, d, 1024)));
            for (const Slot& slot : layout.slots()) {
                if (slot.arity != 2) continue;
                REQUIRE(is_net(padded, slot.dimension, slot.dimension + 1));
                if (slot.role == SlotRole::lens) continue;  // dimensions 2 and 3, t = 1
                REQUIRE(is_net(four, slot.dimension, slot.dimension + 1));
            }
        }
}

TEST_CASE("Products vary as those of one net within a set, and as those of nested orders across sets", "[unit][samplers]") {
    // N = 256. Within a slot: (28 m / 3 + 16 / 9) / (256 N^3). Across: samples whose indices first differ at digit k from below
    // the top share v leading digits with probability 2^-(v+1), v < k, and k digits otherwise; with c_v = ((1 - 4^-v) / 3 -
    // 4^-(v+1)) / 4 the covariance of two values that share v, the mean square is 1/144 + sum over k of 2^k (mean of c)^2, over N:
    // 1.5806 times that of independent numbers.
    constexpr int kSeeds = 2000, kM = 8;
    constexpr double kN = 1 << kM, kNested = 1.5806;
    const DimensionLayout layout = path_layout();
    const auto product = [&](const Points& p, std::size_t a, std::size_t b) {
        double sum = 0;
        for (std::size_t i = 0; i < p.count; ++i) sum += (p(a, i) + 0x1p-25 - 0.5) * (p(b, i) + 0x1p-25 - 0.5) / kN;
        return sum * sum / kSeeds;
    };
    double inside[2] = {}, across[2] = {}, joint = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Points p[2] = {draw_layout<SobolPaddedSampler>(layout, 256, seed), draw_layout<Sobol4DSampler>(layout, 256, seed)};
        for (int s = 0; s < 2; ++s) {
            inside[s] += product(p[s], 6, 7);
            across[s] += product(p[s], 7, 10);  // light position against direction
        }
        joint += product(p[1], 1, 2);  // film against lens: one set
    }
    const double margin = 6 * std::sqrt(2.0 / kSeeds);
    for (int s = 0; s < 2; ++s) {
        REQUIRE(inside[s] * 256 * kN * kN * kN / (28.0 * kM / 3 + 16.0 / 9) == Approx(1).margin(1.3 * margin).epsilon(0));
        REQUIRE(across[s] * 144 * kN / kNested == Approx(1).margin(1.3 * margin).epsilon(0));
    }
    REQUIRE(joint * 144 * kN < 0.02);
}

TEST_CASE("Slots of padded samplers are no copies of each other, at dimensions beyond 1024 too", "[unit][samplers]") {
    const Points p = draw<SobolPaddedSampler>("sobol-padded", {.count = 16, .dimensions = 4000, .arity = 2});
    std::set<float> first;
    for (std::size_t d = 0; d < 4000; ++d) first.insert(p(d, 0));
    REQUIRE(first.size() > 3990);
    const Points q = draw<Sobol4DSampler>("sobol-4d", {.count = 16, .dimensions = 4000});
    for (std::size_t d = 0; d < 4000; ++d) REQUIRE(one_per_stratum(q, d, 16));
}
