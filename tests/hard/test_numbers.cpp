// Small numerics: weights, frames, arguments of roots, what the compiler was allowed to do.

#include <koksma/film/film.h>
#include <koksma/sampling/warps.h>
#include <koksma/scene/light_sampling.h>

#include <koksma_catch.h>

#include <cstring>
#include <limits>

using namespace koksma;

TEST_CASE("F1: the power heuristic of a density beyond the root of float's range is 1", "[hard]") {
    CHECK(power_heuristic(1.9e19f, 1.0f) == 1.0f);
    CHECK(power_heuristic(3e38f, 1e-30f) == 1.0f);
    CHECK(power_heuristic(1.0f, 1.9e19f) == Approx(0.0f).margin(1e-37));
    CHECK(power_heuristic(1e-30f, 3e38f) == 0.0f);
}

TEST_CASE("F2: the power heuristic of equal tiny densities is a half", "[hard]") {
    CHECK(power_heuristic(1e-23f, 1e-23f) == 0.5f);
    CHECK(power_heuristic(1e-37f, 1e-37f) == 0.5f);
}

TEST_CASE("F3: an infinite density takes all, and none is NaN", "[hard]") {
    CHECK(power_heuristic(kInfinity, 1.0f) == 1.0f);
    CHECK(power_heuristic(1.0f, kInfinity) == 0.0f);
    CHECK(power_heuristic(0.0f, 0.0f) == 0.0f);
    CHECK(power_heuristic(0.0f, 1.0f) == 0.0f);
    CHECK(power_heuristic(1.0f, 0.0f) == 1.0f);
}

TEST_CASE("F4: frames are orthonormal to 1e-7 everywhere", "[hard]") {
    double worst = 0;
    const auto check = [&](Vec3f n) {
        const Frame f = Frame::from_normal(n);
        const Vec3d s = to_double(f.s), t = to_double(f.t), m = to_double(f.n);
        for (const double e : {dot(s, s) - 1, dot(t, t) - 1, dot(s, t), dot(s, m), dot(t, m)}) worst = std::max(worst, std::fabs(e));
        const Vec3d c = cross(s, t) - m;
        worst = std::max(worst, length(c));
    };
    for (const float z : {-1.0f, -0.99999994f, -0.9999999f, -0.9999f, -0.99999f, -0.5f, -1e-30f, 0.0f, 1e-30f, 0.5f, 0.99999994f, 1.0f}) {
        const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
        for (int k = 0; k < 64; ++k) {
            const SinCos sc = sincos_turns(static_cast<float>(k) / 64.0f);
            // Unit to the last bit of float, from double.
            const Vec3d v{double{r} * sc.cos, double{r} * sc.sin, double{z}};
            check(to_float(v * (1.0 / length(v))));
        }
    }
    INFO("worst error " << worst);
    // A normal rounded to float is off by 1e-7 itself.
    CHECK(worst <= 3e-7);
}

TEST_CASE("F5: a normalised vector that is too long makes no NaN in a warp or a BSDF", "[hard]") {
    Bsdf b;
    b.kind = BsdfKind::rough_conductor;
    b.perfect = true;
    b.reflectance = Vec3f(1.0f);
    for (const float alpha : {1e-4f, 0.1f, 1.0f})
        for (const bool ggx : {false, true}) {
            b.facets = {alpha, alpha, ggx};
            for (int i = 0; i < 1000; ++i) {
                const float u = static_cast<float>(i) / 1000.0f;
                Vec3f wo = normalize(square_to_cosine_hemisphere<float>({u, std::fmod(u * 37.0f, 1.0f)}));
                if (i == 0) wo = {0, 0, 1.0000004f};
                const BsdfSample s = sample_bsdf<EffectSet::all()>(b, wo, 0.0f, {std::fmod(u * 61.0f, 1.0f), u});
                REQUIRE(is_finite(s.weight));
                REQUIRE(is_finite(s.wi));
            }
        }
    CHECK(one_minus_cos(1.0000004f) <= 1.000001f);
}

TEST_CASE("F7: one minus cosine keeps its digits", "[hard]") {
    for (const double omega : {1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-12}) {
        const double s2 = omega / std::acos(-1.0);
        const auto f = static_cast<float>(s2);
        const double exact = double{f} / (1.0 + std::sqrt(1.0 - double{f}));
        INFO("solid angle " << omega);
        CHECK(std::fabs(one_minus_cos(f) / exact - 1.0) < 1.2e-7);  // two roundings
    }
}

TEST_CASE("F8: the library was compiled with numbers that may be NaN, infinite or tiny", "[hard]") {
    InvalidSample::Kind kind{};
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    CHECK(is_invalid({kNan, 0, 0}, kind));
    CHECK(kind == InvalidSample::Kind::nan);
    CHECK(is_invalid({0, kInfinity, 0}, kind));
    CHECK(kind == InvalidSample::Kind::infinite);
    CHECK(is_invalid({0, 0, -1e-30f}, kind));
    CHECK(kind == InvalidSample::Kind::negative);
    CHECK(is_invalid({0, -kInfinity, kNan}, kind));
    CHECK(kind == InvalidSample::Kind::nan);
    CHECK_FALSE(is_invalid({0, 1e-40f, 3e38f}, kind));
    volatile float denormal = 1e-40f;
    CHECK(denormal * 1.0f > 0.0f);  // the program does not flush
    Film film({0, 0, 1, 1});
    for (int i = 0; i < 156250; ++i) {
        const std::vector<Vec3f> chunk(64, Vec3f(0.1f));
        film.add({0, 0}, chunk);
    }
    CHECK(film.mean().x == Approx(double{0.1f}).epsilon(1e-12));
}
