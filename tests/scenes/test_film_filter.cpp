// Reconstruction filters by importance sampling: where samples fall, at borders too.

#include "render_scene.h"

#include <koksma/sampling/error.h>
#include <koksma/scene/film_filter.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

using Kind = ReconstructionFilter::Kind;

ReconstructionFilter filter_of(Kind kind, double radius, double stddev = 0.5, bool beyond = true) {
    ReconstructionFilter f;
    f.kind = kind;
    f.radius = radius;
    f.stddev = stddev;
    f.beyond_film = beyond;
    return f;
}

/// The filter's value, not normalised.
double value(const ReconstructionFilter& f, double x) {
    x = std::fabs(x);
    if (f.kind == Kind::box) return x < f.radius ? 1.0 : 0.0;
    if (f.kind == Kind::tent) return std::max(0.0, 1.0 - x / f.radius);
    return std::max(0.0, std::exp(-x * x / (2 * f.stddev * f.stddev)) - std::exp(-8.0));
}

/// The part of the filter between two points, by the midpoint rule.
double part(const ReconstructionFilter& f, double from, double to) {
    constexpr int kSteps = 4000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) sum += value(f, from + (to - from) * (i + 0.5) / kSteps);
    return sum * (to - from) / kSteps;
}

}  // namespace

TEST_CASE("samples fall where the filter says", "[scenes]") {
    for (const ReconstructionFilter& f : {filter_of(Kind::box, 1.3), filter_of(Kind::tent, 1.0), filter_of(Kind::tent, 2.5), filter_of(Kind::gaussian, 0, 0.5),
                                          filter_of(Kind::gaussian, 0, 1.1)}) {
        const CompiledFilter c = compile_filter(f);
        const double r = f.kind == Kind::gaussian ? 4 * f.stddev : f.radius, whole = part(f, -r, r);
        constexpr int kCount = 1 << 16;
        float last = -1e9f;
        for (int i = 0; i < kCount; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / kCount, x = c.position(100, 200, u) - 0.5f;
            CHECK(x >= last);
            last = x;
            if (i % 997 == 0) {
                INFO("u " << u << " x " << x);
                CHECK(std::fabs(part(f, -r, x) / whole - u) < 2e-5);
            }
        }
    }
    CHECK(compile_filter({}).is_pixel());
    CHECK_THROWS_AS(compile_filter(filter_of(Kind::tent, 0.0)), Error);
    CHECK_THROWS_AS(compile_filter(filter_of(Kind::tent, 40.0)), Error);
}

TEST_CASE("at the film's borders the filter is cut off and what is left has weight one", "[scenes]") {
    const ReconstructionFilter f = filter_of(Kind::gaussian, 0, 0.5, false);
    const CompiledFilter c = compile_filter(f);
    for (const std::int32_t pixel : {0, 1, 2, 5}) {
        const double from = std::max(-2.0, -pixel - 0.5), to = std::min(2.0, 5.5 - pixel), whole = part(f, from, to);
        for (int i = 0; i < 64; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / 64, x = c.position(pixel, 6, u);
            CHECK(static_cast<float>(pixel) + x >= -1e-6f);
            CHECK(static_cast<float>(pixel) + x <= 6.0f + 1e-6f);
            CHECK(std::fabs(part(f, from, x - 0.5) / whole - u) < 2e-5);
        }
    }
}

TEST_CASE("a filtered picture of an edge has the filter's step", "[scenes]") {
    // A bright half plane that ends at the left border of pixel 8, seen by an orthographic camera: pixels are areas of the filter.
    SceneDescription d = empty_scene(16, 1);
    d.camera.orthographic = true;
    d.camera.to_world = look_at({0, 0, 5}, {0, 0, 0});
    d.integrator.max_depth = 1;
    add_light(d, RectangleShape{}, translated({-1, 0, 0}), Rgb(1.0f));
    const Ready box(d);
    d.film.filter = filter_of(Kind::gaussian, 0, 0.5, false);
    const Ready gaussian(d);
    const Film sharp = box.render(kSobol, 1024, 3).film, soft = gaussian.render(kSobol, 1024, 3).film;
    for (std::int32_t x = 0; x < 16; ++x) {
        INFO("pixel " << x);
        CHECK(sharp.mean({x, 0}).y == (x < 8 ? 1.0 : 0.0));
        const double expected = part(d.film.filter, -2, std::min(2.0, 7.5 - x)) / part(d.film.filter, -2, 2);
        CHECK(std::fabs(soft.mean({x, 0}).y - (x < 6 ? 1.0 : x > 9 ? 0.0 : expected)) < 2e-3);
    }
}

TEST_CASE("moments are the means of the samples' X, Y, Z squared", "[scenes]") {
    // Half of a pixel's samples see 3, half see nothing.
    SceneDescription d = empty_scene(1, 1);
    d.camera.orthographic = true;
    d.camera.to_world = look_at({0, 0, 5}, {0, 0, 0});
    d.integrator.max_depth = 1;
    add_light(d, RectangleShape{}, translated({-1, 0, 0}), Rgb(3.0f));
    CHECK_FALSE(Ready(d).render(kSobol, 64, 3).film.has_moments());
    d.integrator.moments = "img";
    const Film film = Ready(d).render(kSobol, 64, 3).film;
    const Vec3d bright = xyz_of({3, 3, 3}), second = film.second_moment({0, 0});
    CHECK(film.mean({0, 0}).y == 1.5);
    CHECK(std::fabs(second.x - 0.5 * bright.x * bright.x) < 1e-9);
    CHECK(std::fabs(second.y - 0.5 * bright.y * bright.y) < 1e-9);
    CHECK(std::fabs(second.z - 0.5 * bright.z * bright.z) < 1e-9);
}
