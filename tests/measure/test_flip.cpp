// FLIP against the published evaluator. Its values are those of flip_oracle.py beside this file, whose images these are.

#include <koksma/measure/flip.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace koksma;

namespace {

constexpr int kWidth = 61, kHeight = 47;

/// [0, 1) in steps of 2^-16.
double hashed(std::uint32_t x, std::uint32_t y, std::uint32_t c, std::uint32_t seed) {
    std::uint32_t h = x * 73856093u ^ y * 19349663u ^ c * 83492791u ^ seed * 2654435761u;
    h = (h ^ (h >> 15)) * 2246822519u;
    h = (h ^ (h >> 13)) * 3266489917u;
    return (h >> 16) / 65536.0;
}

std::vector<float> image(const std::string& name, bool is_test) {
    std::vector<float> out;
    for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x)
            for (std::uint32_t c = 0; c < 3; ++c) {
                double v = 0;
                if (name == "noise") {
                    v = 0.1 + 0.8 * x / kWidth * (1 - 0.3 * c * y / kHeight);
                    v *= is_test ? 0.7 + 0.6 * hashed(x, y, c, 1) : 1;
                } else if (name == "edge") {
                    const std::uint32_t moved = is_test ? 2 : 0;
                    v = x >= 20 + moved && x < 40 + moved && y >= 12 && y < 30 ? 0.9 - 0.2 * c : 0.02 + 0.01 * c;
                } else {
                    v = 0.01 * std::ldexp(1, static_cast<int>(12 * x / kWidth)) * (1 + 0.25 * c);
                    if (is_test) v = v * (0.5 + hashed(x, y, 0, 2)) + (hashed(x, y, 0, 3) > 0.98 ? 200 : 0);
                }
                out.push_back(static_cast<float>(v));
            }
    return out;
}

struct Oracle {
    const char* name;
    double ldr, hdr;              ///< means
    double ldr_pixel, hdr_pixel;  ///< at row 11, column 23
    double start, stop;
    int exposures;
};
constexpr Oracle kOracle[] = {
    {"noise", 0.1293281, 0.0931717, 0.1382786, 0.1102696, 1.25648, 2.26438, 2},
    {"edge", 0.0834230, 0.0721184, 0.2164665, 0.1780930, 1.54113, 6.21134, 5},
    {"fireflies", 0.1243897, 0.2293929, 0.1175575, 0.3745365, -3.55368, 2.44632, 6},
};
constexpr std::size_t kPixel = 11 * kWidth + 23;

std::vector<float> clamped(std::vector<float> v) {
    for (float& x : v) x = std::clamp(x, 0.0f, 1.0f);
    return v;
}

}  // namespace

TEST_CASE("FLIP has the values of the published evaluator", "[unit][measure]") {
    for (const Oracle& o : kOracle) {
        CAPTURE(o.name);
        const std::vector<float> reference = image(o.name, false), test = image(o.name, true);
        const std::vector<float> ldr = ldr_flip(clamped(reference), clamped(test), kWidth, kHeight);
        CHECK(std::abs(mean_of_map(ldr) - o.ldr) < 1e-4);
        CHECK(std::abs(static_cast<double>(ldr[kPixel]) - o.ldr_pixel) < 1e-4);
        const HdrFlip flip(reference, kWidth, kHeight);
        CHECK(flip.exposures() == o.exposures);
        CHECK(std::abs(flip.start_exposure() - o.start) < 1e-4);
        CHECK(std::abs(flip.stop_exposure() - o.stop) < 1e-4);
        CHECK(std::abs(flip.mean(test) - o.hdr) < 1e-4);
        CHECK(std::abs(static_cast<double>(flip.map(test)[kPixel]) - o.hdr_pixel) < 1e-4);
    }
}

TEST_CASE("an image does not differ from itself", "[unit][measure]") {
    const std::vector<float> x = image("fireflies", true);
    CHECK(mean_of_map(ldr_flip(clamped(x), clamped(x), kWidth, kHeight)) == 0);
    CHECK(HdrFlip(x, kWidth, kHeight).mean(x) == 0);
}

TEST_CASE("FLIP of what it cannot see is not a number, and a mask leaves pixels out", "[unit][measure]") {
    const std::vector<float> black(3 * kWidth * kHeight, 0.0f);
    std::vector<float> test = image("noise", true);
    CHECK(HdrFlip(black, kWidth, kHeight).map(test).empty());
    CHECK(std::isnan(HdrFlip(black, kWidth, kHeight).mean(test)));
    const HdrFlip flip(image("noise", false), kWidth, kHeight);
    std::vector<unsigned char> skip(kWidth * kHeight, 1);
    CHECK(std::isnan(flip.mean(test, skip)));
    skip[kPixel] = 0;
    CHECK(flip.mean(test, skip) == static_cast<double>(flip.map(test)[kPixel]));
    test[5] = std::numeric_limits<float>::quiet_NaN();
    CHECK(std::isnan(flip.mean(test)));
    CHECK_THROWS_AS(flip.map(std::vector<float>(3)), Error);
    CHECK_THROWS_AS(HdrFlip(test, kWidth, 3), Error);
}

TEST_CASE("a reference that is black in most pixels is seen up to the exposure that the evaluator stops at", "[unit][measure]") {
    std::vector<float> reference(3 * 20 * 20, 0.0f), test;
    for (std::size_t y = 0; y < 20; ++y) std::fill_n(&reference[3 * 20 * y], 24, 0.5f);
    std::fill_n(&reference[3 * (3 * 20 + 3)], 3, 20.0f);
    test = reference;
    for (std::size_t y = 0; y < 20; ++y)
        for (std::size_t i = 0; i < 24; ++i) test[60 * y + i] *= 1.3f;
    const HdrFlip flip(reference, 20, 20);
    CHECK(flip.exposures() == 28);
    CHECK(std::abs(flip.stop_exposure() - 24.0832977) < 1e-4);
    CHECK(std::abs(flip.mean(test) - 0.1389772) < 1e-4);
}
