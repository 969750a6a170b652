// Seeds, pixels and dimensions give keys of their own; replicates by consecutive seeds are independent.

#include "draw.h"

#include <samplers/halton.h>
#include <samplers/random.h>
#include <samplers/sobol.h>
#include <samplers/stratified.h>

#include <koksma_catch.h>

#include <cmath>
#include <set>
#include <string>
#include <unordered_set>

using namespace koksma;
using namespace koksma::test;

namespace {

template <class S>
void check_replicates(const std::string& spec) {
    constexpr std::uint64_t kSeeds = 4096;
    constexpr std::size_t kCount = 4, kDimensions = 6;
    std::vector<Points> seeds, pixels;
    for (std::uint64_t s = 0; s < kSeeds; ++s) {
        seeds.push_back(draw<S>(spec, {.count = kCount, .seed = s, .dimensions = kDimensions}));
        const Pixel pixel{static_cast<std::int32_t>(s % 64), static_cast<std::int32_t>(s / 64)};
        pixels.push_back(draw<S>(spec, {.count = kCount, .seed = 1, .dimensions = kDimensions, .pixel = pixel}));
    }
    for (const auto* replicates : {&seeds, &pixels}) {
        std::set<std::pair<float, float>> distinct;
        for (const Points& p : *replicates) distinct.insert({p(0, 3), p(1, 3)});
        REQUIRE(distinct.size() == kSeeds);  // two equal pairs of 24 bits: probability 2^-25
        for (std::size_t d = 0; d < kDimensions; ++d)
            for (std::size_t i = 0; i < kCount; ++i) {
                double next = 0, other = 0;  // correlation with the next replicate, and between dimensions
                for (std::uint64_t s = 0; s + 1 < kSeeds; ++s) {
                    const double x = (*replicates)[s](d, i) - 0.5;
                    next += 12 * x * ((*replicates)[s + 1](d, i) - 0.5);
                    other += 12 * x * ((*replicates)[s]((d + 1) % kDimensions, i) - 0.5);
                }
                constexpr double kSixSigma = 6 * 64;  // sqrt(kSeeds) = 64
                REQUIRE((std::abs(next) < kSixSigma && std::abs(other) < kSixSigma));
            }
    }
}

}  // namespace

TEST_CASE("Replicates by consecutive seeds and neighbouring pixels are independent", "[unit][samplers]") {
    check_replicates<RandomSampler>("random");
    check_replicates<StratifiedSampler>("stratified");
    for (const char* randomize : {"cp", "digits", "owen"}) check_replicates<HaltonSampler>(std::string("halton:randomize=") + randomize);
    for (const char* randomize : {"xor", "owen", "owen-exact"}) check_replicates<SobolSampler>(std::string("sobol:randomize=") + randomize);
}

TEST_CASE("Keys of pixels, seeds and samples are distinct", "[unit][samplers]") {
    std::unordered_set<std::uint64_t> keys;
    for (std::uint64_t seed = 0; seed < 64; ++seed)
        for (std::int32_t y = -4; y < 28; ++y)
            for (std::int32_t x = -4; x < 28; ++x) keys.insert(join_key(pixel_key(seed, {x, y})));
    REQUIRE(keys.size() == 64u * 32u * 32u);
    std::unordered_set<std::uint32_t> words;  // one word per dimension: distinct within a pixel, for every pixel
    for (std::uint32_t d = 0; d < 4096; ++d) words.insert(keyed_hash(pixel_key(3, {5, 7}), d));
    REQUIRE(words.size() == 4096u);
}

TEST_CASE("Two samplers under one seed have scrambles of their own", "[unit][samplers]") {
    // Base 2 is the first dimension of both: equal keys would make it the same points, and pooled replicates dependent.
    constexpr Draw kDraw{.count = 8, .dimensions = 1};
    REQUIRE(draw<HaltonSampler>("halton", kDraw).values != draw<SobolSampler>("sobol", kDraw).values);
    REQUIRE(draw<StratifiedSampler>("stratified", {.dimensions = 1}).values != draw<RandomSampler>("random", {.dimensions = 1}).values);
}

TEST_CASE("Dimensions past the table come from the tail", "[unit][samplers]") {
    // plain_layout gives every slot a bounce of its own.
    const auto tail = [](std::uint32_t bounce) { return tail_sample(0, {{}, 1}, bounce, SlotRole::direction, 0); };
    REQUIRE(draw<HaltonSampler>("halton", {.count = 2, .dimensions = 1026})(1024, 1) == tail(1024));
    REQUIRE(draw<HaltonSampler>("halton", {.count = 2, .dimensions = 1026})(1025, 1) == tail(1025));
    REQUIRE(draw<SobolSampler>("sobol", {.count = 2, .dimensions = 4097})(4096, 1) == tail(4096));
}
