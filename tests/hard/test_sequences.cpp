// Sequences at their ends: last strata, large bases and indices, dimensions beyond tables. And the roulette of the lectures.

#include <samplers/draw.h>
#include <samplers/film_draw.h>
#include <scenes/render_scene.h>

#include <samplers/halton.h>
#include <samplers/random.h>
#include <samplers/sobol.h>
#include <samplers/stratum.h>

#include <set>

using namespace koksma;
using namespace koksma::testing;
using koksma::test::draw;
using koksma::test::draw_film;

namespace {

/// The names of all samplers that need no file.
std::vector<std::string> all_samplers() {
    std::vector<std::string> names;
    for (const SamplerInfo& info : samplers().infos())
        if (info.name != "points") names.emplace_back(info.name);
    return names;
}

}  // namespace

TEST_CASE("A5: roulette with a survival of its own has the lecture's mean and variance", "[hard]") {
    // f(x) = x^2 on [0, 1): if x < P then f(x / P) / P, else 0. Mean 1/3, variance (1/P) / 5 - 1/9.
    for (const double p : {1.0, 0.5, 0.1}) {
        constexpr std::uint64_t kCount = 1 << 22, kBlock = 1 << 16;
        double sum = 0, squares = 0, fourths = 0;
        for (std::uint64_t first = 0; first < kCount; first += kBlock) {
            const auto x = draw<RandomSampler>("random", {.count = kBlock, .first = first, .seed = 5, .dimensions = 1});
            for (std::size_t i = 0; i < kBlock; ++i) {
                const double u = (x(0, i) + 0x1p-25) / p, value = u < 1.0 ? u * u / p : 0.0;
                sum += value;
                squares += value * value;
            }
        }
        const double mean = sum / kCount, variance = squares / kCount - mean * mean, expected = 0.2 / p - 1.0 / 9.0;
        // Moments of x^2 / P with probability P: the variance of the squared deviation, for the error of the variance.
        fourths = 1.0 / (9.0 * p * p * p) - 4.0 / 3.0 / (7.0 * p * p) + 6.0 / 9.0 / (5.0 * p) - 4.0 / 27.0 / 3.0 + 1.0 / 81.0;
        INFO("P " << p << " mean " << mean << " variance " << variance << " expected " << expected);
        CHECK(std::fabs(mean - 1.0 / 3.0) < 4.0 * std::sqrt(expected / kCount));
        CHECK(std::fabs(variance - expected) < 4.0 * std::sqrt((fourths - expected * expected) / kCount));
    }
}

TEST_CASE("E3: the last jitter of the last stratum stays below 1", "[hard]") {
    for (std::uint64_t n = 1; n <= (1u << 20); n = n < 4096 ? n + 1 : n + n / 3)
        for (const double u : {0.0, 1.0 - 0x1p-24, 1.0 - 0x1p-53}) {
            const float x = stratum_float(n - 1, n, 0x1p24 / static_cast<double>(n), u);
            INFO("stratum " << n - 1 << " of " << n << " jitter " << u << " gives " << x);
            REQUIRE(x < 1.0f);
            REQUIRE(double{x} * static_cast<double>(n) >= static_cast<double>(n - 1));
        }
}

TEST_CASE("E5: radical inverses in large bases at large indices are within half a unit of the last place, and below 1", "[hard]") {
    const auto base_of = [](std::uint32_t prime) -> const HaltonBase& {
        const HaltonBase* b = halton_bases();
        while (b->base != prime) ++b;
        return *b;
    };
    const auto cube = [](std::uint64_t b) { return b * b * b - 1; };
    struct Row {
        std::uint32_t base;
        std::uint64_t index;
        double value;
    };
    for (const Row& row : {Row{2, (1ull << 32) + 1, .50000000011641532},
                           {3, 1ull << 32, .53723727477847385},
                           {3, 3486784400ull, .9999999997132028},
                           {541, cube(541), .99999999368449323},
                           {1009, cube(1009), .99999999902652119},
                           {7919, 1000000000000ull, .52661665733843646},
                           {7919, (1ull << 52) - 1, .3919485551626496}}) {
        const float x = radical_inverse(base_of(row.base), row.index);
        INFO("base " << row.base << " index " << row.index << " gives " << x);
        CHECK(x < 1.0f);
        // Upwards to a multiple of 2^-24, so that strata hold (docs/design.md): at most one such unit from the value.
        CHECK(std::fabs(double{x} - row.value) <= 0x1p-24);
    }
    for (const std::uint64_t i : {(1ull << 25) - 1, 43046720ull, 48828124ull})
        CHECK(radical_inverse(base_of(i == 43046720 ? 3 : i == 48828124 ? 5 : 2), i) < 1.0f);
}

TEST_CASE("E6: permuted digits go on after the last digit of the index", "[hard]") {
    // Index 0 has no digits; with permuted zeros it is anywhere in [0, 1), and all bits of it vary.
    for (const char* spec : {"halton:randomize=digits", "halton:randomize=owen", "faure:randomize=owen"}) {
        std::uint64_t ones = 0, zeros = 0;
        double mean = 0;
        for (std::uint64_t seed = 0; seed < 1024; ++seed) {
            const auto source = samplers().make(spec)->bind({.spp = 1, .seed = seed, .layout = test::film_layout(2, false)});
            const SampleId id{{3, 4}, 0};
            float u[4];
            source->fill({&id, 1}, test::film_layout(2, false).slots(), u, 1);
            for (const float x : u) {
                const auto bits = static_cast<std::uint64_t>(double{x} * 0x1p24);
                ones |= bits;
                zeros |= ~bits;
                mean += double{x} / 4096;
            }
        }
        INFO(spec << " mean " << mean);
        CHECK((ones & 0xffffff) == 0xffffff);
        CHECK((zeros & 0xffffff) == 0xffffff);
        CHECK(std::fabs(mean - 0.5) < 5.0 / std::sqrt(12.0 * 4096));
    }
}

TEST_CASE("E7: dimensions beyond a sampler's table are new ones, not the first again", "[hard]") {
    constexpr std::uint32_t kDimensions = 4200;
    constexpr std::uint64_t kCount = 64;
    const std::vector<std::uint8_t> arities(kDimensions, 1);
    const SamplingPlan plan{.film_width = 4, .film_height = 4, .spp = kCount, .seed = 7, .layout = plain_layout(arities)};
    std::vector<SampleId> ids(kCount);
    for (std::uint64_t i = 0; i < kCount; ++i) ids[i] = {{1, 2}, i};
    for (const std::string& name : all_samplers()) {
        // Matrices from a file are refused where they end (tests/samplers).
        if (name == "matrices") {
            CHECK_THROWS_AS((void)samplers().make(name)->bind(plan), Error);
            continue;
        }
        const auto source = samplers().make(name)->bind(plan);
        std::vector<float> u(std::size_t{kDimensions} * kCount);
        source->fill(ids, plan.layout.slots(), u.data(), kCount);
        std::set<std::vector<float>> seen;
        for (std::uint32_t d = 0; d < kDimensions; ++d) {
            const float* row = u.data() + std::size_t{d} * kCount;
            for (std::uint64_t i = 0; i < kCount; ++i) REQUIRE((row[i] >= 0.0f && row[i] < 1.0f));
            seen.insert(std::vector<float>(row, row + kCount));
        }
        INFO(name);
        CHECK(seen.size() == kDimensions);
    }
}

TEST_CASE("E8: samples with indices beyond 2^32 are distinct and lie in their pixel", "[hard]") {
    // 7680 x 4320 pixels on a grid of 8192 x 8192: sample 64 of a pixel has an index of 2^32 and more.
    for (const char* spec : {"sobol-global", "halton-global", "sobol-global:randomize=none"}) {
        const auto p = draw_film(*samplers().make(spec), {.width = 7680,
                                                          .height = 4320,
                                                          .spp = 128,
                                                          .seed = 3,
                                                          .first = 0,
                                                          .pairs = 3,
                                                          .film_slot = true,
                                                          .x0 = 7677,
                                                          .y0 = 4318,
                                                          .columns = 3,
                                                          .rows = 2});
        INFO(spec);
        for (std::size_t pixel = 0; pixel < 6; ++pixel) {
            std::set<std::vector<float>> points;
            for (std::size_t i = 0; i < 128; ++i) {
                std::vector<float> point;
                for (std::size_t d = 0; d < 6; ++d) {
                    const float x = p(d, pixel * 128 + i);
                    REQUIRE((x >= 0.0f && x < 1.0f));
                    point.push_back(x);
                }
                points.insert(point);
            }
            CHECK(points.size() == 128);
        }
    }
    // A pixel's own index beyond 2^32, where the sampler has no limit there.
    for (const std::string& name : all_samplers()) {
        const SamplerInfo info = samplers().make(name)->info();
        if (info.max_samples <= (1ull << 33)) continue;
        const auto source =
            samplers().make(name)->bind({.film_width = 4, .film_height = 4, .spp = 64, .seed = 7, .layout = test::film_layout(2, false)});
        std::set<std::vector<float>> points;
        std::vector<SampleId> ids;
        for (std::uint64_t i = 0; i < 32; ++i) {
            ids.push_back({{1, 2}, i});
            ids.push_back({{1, 2}, i + (1ull << 32)});
        }
        std::vector<float> u(4 * ids.size());
        source->fill(ids, test::film_layout(2, false).slots(), u.data(), ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) points.insert({u[i], u[ids.size() + i], u[2 * ids.size() + i], u[3 * ids.size() + i]});
        INFO(name);
        CHECK(points.size() == ids.size());
    }
}
