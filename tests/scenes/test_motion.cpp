// Things that move while the shutter is open, against what stands still at many instants.

#include "render_scene.h"

#include <koksma/sampling/error.h>
#include <koksma/scene/animation.h>

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

bool near(const Matrix& a, const Matrix& b, double tolerance) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!(std::fabs(a[c][r] - b[c][r]) <= tolerance)) return false;
    return true;
}

/// A white sky seen past something black: the mean over the film is the part that is not covered.
SceneDescription silhouette() {
    SceneDescription d = empty_scene(8, 8);
    d.environment = ConstantEnvironment{};
    d.camera.to_world = look_at({0, 0, -4}, {0, 0, 0});
    d.camera.fov_x_degrees = 50;
    d.integrator.max_depth = 2;
    return d;
}

}  // namespace

TEST_CASE("between keyframes a rotation turns at a constant rate, and the rest changes linearly", "[scenes]") {
    const Matrix end = translated({2, 0, 4}) * rotated({0.6, 0.8, 0}, 120) * scaled({2, 1, -3});
    const Animation a{{1.0, scaled({1, 1, -1})}, {3.0, end}};
    CHECK(placement_at(a, 0.0) == a[0].to_world);
    CHECK(placement_at(a, 5.0) == end);
    CHECK(near(placement_at(a, 1.5), translated({0.5, 0, 1}) * rotated({0.6, 0.8, 0}, 30) * scaled({1.25, 1, -1.5}), 1e-12));
    // Steps are as many as it takes: one of a straight line, more of a turn.
    CHECK(sampled({{0.0, Matrix(1.0)}, {1.0, translated({5, 0, 0})}}, 0.25, 0.75).size() == 2);
    CHECK(near(sampled({{0.0, Matrix(1.0)}, {1.0, translated({5, 0, 0})}}, 0.25, 0.75)[1], translated({3.75, 0, 0}), 1e-12));
    const auto turn = sampled({{0.0, Matrix(1.0)}, {1.0, rotated({0, 0, 1}, 90)}}, 0.0, 1.0);
    CHECK(turn.size() > 32);
    const double step = std::numbers::pi / 2 / static_cast<double>(turn.size() - 1);
    CHECK(1.0 - std::cos(0.5 * step) <= 1e-4);  // how far the middle of a chord lies inside the circle
    CHECK(sampled(a, 4.0, 5.0).size() == 1);
}

TEST_CASE("a shutter that is shut at once takes nothing and gives the shape where it is", "[scenes]") {
    SceneDescription moving = silhouette(), still = silhouette();
    const std::uint32_t grey = add_diffuse(moving, 0.5f);
    static_cast<void>(add_diffuse(still, 0.5f));
    add_shape(moving, CubeShape{}, Matrix(1.0), grey).animation = {{0.0, translated({-1, 0, 0})}, {1.0, translated({1, 0, 0})}};
    moving.camera.shutter_open = moving.camera.shutter_close = 0.75;
    add_shape(still, CubeShape{}, translated({0.5, 0, 0}), grey);
    const Ready a(moving), b(still);
    CHECK_FALSE(a.plan.effects.has(Effect::motion));
    CHECK_FALSE(a.plan.effects.has(Effect::instancing));
    CHECK(a.plan.time == -1);
    CHECK(same_bytes(a.render(kSobol, 4, 1).film, b.render(kSobol, 4, 1).film));
    // Open, but nothing happens then.
    moving.camera.shutter_open = 2.0;
    moving.camera.shutter_close = 3.0;
    CHECK_FALSE(Ready(moving).plan.effects.has(Effect::motion));
}

TEST_CASE("a moving shape covers what the shapes at rest cover on average", "[scenes]") {
    const std::vector<std::pair<Geometry, Animation>> moving{
        {SphereShape{}, {{0.0, translated({-1, 0, 0}) * scaled(0.5)}, {1.0, translated({1, 0.5, 0}) * scaled(0.5)}}},
        {CubeShape{}, {{0.0, scaled({1, 0.2, 0.2})}, {0.4, rotated({0, 0, 1}, 60) * scaled({1, 0.2, 0.2})}, {1.0, rotated({0, 0, 1}, 200) * scaled({0.5, 0.3, 0.2})}}},
        {DiskShape{}, {{0.0, translated({0, 1, 0}) * rotated({1, 0, 0}, 180)}, {1.0, translated({0, -1, 1}) * rotated({1, 0, 0}, 180) * scaled(0.5)}}}};
    for (const auto& [geometry, animation] : moving) {
        SceneDescription d = silhouette();
        const std::uint32_t black = add_diffuse(d, 0.0f, true);
        add_shape(d, geometry, animation[0].to_world, black).animation = animation;
        d.camera.shutter_open = 0.1;
        d.camera.shutter_close = 0.9;
        const Ready blurred(d);
        REQUIRE(blurred.plan.effects.has(Effect::motion));
        constexpr int kInstants = 256;
        const Measured got = measure(blurred, 1024);
        std::vector<double> pixels(64, 0.0);
        double mean = 0.0;
        const Film film = blurred.render(kSobol, 4096, 5).film;
        for (int i = 0; i < kInstants; ++i) {
            SceneDescription at_rest = d;
            at_rest.shapes[0].animation.clear();
            at_rest.shapes[0].to_world = placement_at(animation, 0.1 + 0.8 * (i + 0.5) / kInstants);
            const Film one = Ready(at_rest).render(kSobol, 64, static_cast<std::uint64_t>(i)).film;
            mean += one.mean().y / kInstants;
            for (std::int32_t p = 0; p < 64; ++p) pixels[static_cast<std::size_t>(p)] += one.mean({p % 8, p / 8}).y / kInstants;
        }
        // An instant's coverage is a smooth function of time, up to corners: the midpoint rule is good to 1e-4 over the film. 1e-4 is also
        // what the straight steps may be off.
        INFO(got.mean << " +- " << got.standard_error << " against " << mean);
        CHECK(std::fabs(got.mean - mean) <= got.noise() + 5e-4);
        for (std::int32_t p = 0; p < 64; ++p) CHECK(std::fabs(film.mean({p % 8, p / 8}).y - pixels[static_cast<std::size_t>(p)]) <= 0.02);
    }
}

TEST_CASE("what cannot move is refused", "[scenes]") {
    SceneDescription d = silhouette();
    Shape& lamp = add_light(d, SphereShape{}, Matrix(1.0), Rgb(1.0f));
    lamp.animation = {{0.0, Matrix(1.0)}, {1.0, translated({1, 0, 0})}};
    CHECK_NOTHROW(Ready(d));  // nothing moves while the shutter is shut
    d.camera.shutter_close = 1.0;
    CHECK_THROWS_AS(Ready(d), Error);
    d.shapes[0].emission.reset();
    CHECK_NOTHROW(Ready(d));
    d.shapes[0].animation[1].to_world = scaled({-1, 1, 1});
    CHECK_THROWS_AS(Ready(d), Error);  // through a mirror
    d.camera.shutter_close = -1.0;
    CHECK_THROWS_AS(Ready(d), Error);
}
