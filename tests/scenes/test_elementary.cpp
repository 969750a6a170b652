// Elementary functions against the C library in double, with the errors that their comments promise.

#include <koksma/simd/elementary.h>

#include <koksma_catch.h>

#include <algorithm>

using namespace koksma;

TEST_CASE("sincos_turns is within 1e-7 of sine and cosine", "[scenes]") {
    const double two_pi = 2.0 * std::acos(-1.0);
    double worst = 0, worst_length = 0;
    for (int i = -(1 << 20); i <= (1 << 20); ++i) {
        const float u = static_cast<float>(i) * 0x1p-20f;
        const SinCos sc = sincos_turns(u);
        worst = std::max({worst, std::fabs(sc.sin - std::sin(two_pi * u)), std::fabs(sc.cos - std::cos(two_pi * u))});
        worst_length = std::max(worst_length, std::fabs(double{sc.sin} * sc.sin + double{sc.cos} * sc.cos - 1.0));
    }
    INFO("worst error " << worst << ", of the squared length " << worst_length);
    CHECK(worst < 1e-7);
    CHECK(worst_length < 2e-7);
    // Exact reduction: whole turns change nothing.
    for (const float u : {0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.75f})
        for (const float whole : {1.0f, -3.0f, 4096.0f, 1048576.0f}) {
            CHECK(sincos_turns(u + whole).sin == sincos_turns(u).sin);
            CHECK(sincos_turns(u + whole).cos == sincos_turns(u).cos);
        }
    CHECK(sincos_turns(0.25f).sin == 1.0f);
    CHECK(sincos_turns(0.5f).cos == -1.0f);
}

TEST_CASE("exp_poly is within 2e-7 of exp, relatively", "[scenes]") {
    double worst = 0;
    for (int i = 0; i <= 1 << 20; ++i) {
        const float x = -86.9f + 174.9f * static_cast<float>(i) * 0x1p-20f;
        worst = std::max(worst, std::fabs(double{exp_poly(x)} / std::exp(double{x}) - 1.0));
    }
    INFO("worst relative error " << worst);
    CHECK(worst < 2e-7);
    CHECK(exp_poly(0.0f) == 1.0f);
    CHECK(exp_poly(-100.0f) == 0.0f);
    CHECK(exp_poly(-1e30f) == 0.0f);
}

TEST_CASE("log_poly is within 2e-7 of log, relatively, and 1e-7 near 1", "[scenes]") {
    double worst = 0, near_one = 0;
    for (int i = 1; i <= 1 << 20; ++i) {
        const float x = std::exp2(-126.0f + 253.0f * static_cast<float>(i) * 0x1p-20f), y = static_cast<float>(i) * 0x1p-20f * 2.0f;
        const double exact = std::log(double{x});
        if (std::fabs(exact) > 0.1) worst = std::max(worst, std::fabs(log_poly(x) / exact - 1.0));
        if (y > 0.9f && y < 1.1f) near_one = std::max(near_one, std::fabs(log_poly(y) - std::log(double{y})));
    }
    INFO("worst relative error " << worst << ", absolute near 1 " << near_one);
    CHECK(worst < 2e-7);
    CHECK(near_one < 1e-7);
    CHECK(log_poly(1.0f) == 0.0f);
    // What Beckmann's sampling meets: 1 - u, down to 2^-24.
    CHECK(log_poly(0x1p-24f) == Approx(-24.0 * std::log(2.0)).epsilon(2e-7));
}

TEST_CASE("atan2_poly is within 4e-7 of atan2 in every quadrant", "[scenes]") {
    double worst = 0;
    for (int i = 0; i < 1 << 20; ++i) {
        const SinCos sc = sincos_turns(static_cast<float>(i) * 0x1p-20f);
        for (const float scale : {1e-18f, 1.0f, 1e18f}) {
            double e = std::fabs(atan2_poly(sc.sin * scale, sc.cos * scale) - std::atan2(double{sc.sin}, double{sc.cos}));
            e = std::min(e, std::fabs(e - 2.0 * std::acos(-1.0)));  // the two ends of the cut
            worst = std::max(worst, e);
        }
    }
    INFO("worst error " << worst);
    CHECK(worst < 4e-7);
    CHECK(atan2_poly(0.0f, 0.0f) == 0.0f);
    CHECK(atan2_poly(1.0f, 0.0f) == Approx(std::acos(0.0)));
    CHECK(atan2_poly(-1.0f, 0.0f) == Approx(-std::acos(0.0)));
    CHECK(atan2_poly(0.0f, -1.0f) == Approx(std::acos(-1.0)));
}
