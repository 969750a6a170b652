// Samples that are no radiance: counted, located, replayable, never hidden.

#include "render_scene.h"

#include <koksma/integrators/replay.h>
#include <koksma/sampling/error.h>

#include <limits>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// The left half of the film sees two facing mirrors that shine with 3e38: their sum is beyond float. The right half sees 1.
SceneDescription overflow_on_the_left() {
    SceneDescription d = empty_scene(16, 16);
    d.environment = ConstantEnvironment{};
    const std::uint32_t mirror = add_material(d, Conductor{});
    const auto shine = [&](const Matrix& at) { add_shape(d, RectangleShape{}, at, mirror).emission = AreaEmission{Rgb(3e38f), {}}; };
    // The camera looks along +z and its +x is left in the image.
    shine(translated({5, 0, 3}) * scaled(5) * rotated({0, 1, 0}, 180));
    shine(translated({5, 0, -3}) * scaled(5));
    d.camera.fov_x_degrees = 20;
    d.integrator.max_depth = 8;
    return d;
}

}  // namespace

TEST_CASE("samples that overflow are counted and located, add nothing, and can be replayed", "[scenes]") {
    const Ready ready(overflow_on_the_left());
    const RenderResult r = ready.render("random", 4, 1);
    CHECK(r.stats.invalid_samples == 8 * 16 * 4);
    REQUIRE(r.stats.invalid.size() == RenderStats::kMaxLocated);
    CHECK(r.film.count({0, 0}) == 4);
    CHECK(r.film.mean({0, 0}) == Vec3d{});
    CHECK(r.film.mean({12, 3}).x == 1.0);
    for (std::size_t i = 0; i < r.stats.invalid.size(); ++i) {
        const InvalidSample& s = r.stats.invalid[i];
        CHECK(s.kind == InvalidSample::Kind::infinite);
        CHECK(s.id.pixel.x < 8);
        // The first ones, in order of row, column and sample: 32 a row.
        CHECK(s.id.pixel.y == static_cast<std::int32_t>(i / 32));
        CHECK(s.id.index == i % 4);
    }
    const auto source = samplers().make("random")->bind(sampling_plan(ready.scene, ready.plan, 4, 1));
    CHECK(replay(ready.scene, ready.plan, *source, r.stats.invalid[5].id).find("INVALID: infinite") != std::string::npos);
    CHECK(replay(ready.scene, ready.plan, *source, {{12, 3}, 0}).find("INVALID") == std::string::npos);
}

TEST_CASE("the ledger of invalid samples does not depend on threads", "[scenes]") {
    const Ready ready(overflow_on_the_left());
    RenderOptions one, four;
    one.threads = 1;
    four.threads = 4;
    const RenderStats a = ready.render("random", 8, 1, one).stats, b = ready.render("random", 8, 1, four).stats;
    CHECK(a.invalid_samples == b.invalid_samples);
    REQUIRE(a.invalid.size() == b.invalid.size());
    for (std::size_t i = 0; i < a.invalid.size(); ++i) {
        CHECK(a.invalid[i].id.pixel == b.invalid[i].id.pixel);
        CHECK(a.invalid[i].id.index == b.invalid[i].id.index);
    }
}

TEST_CASE("radiance is classified", "[scenes]") {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    InvalidSample::Kind kind{};
    CHECK_FALSE(is_invalid({0, 0, 0}, kind));
    CHECK_FALSE(is_invalid({-0.0f, 1, 3e38f}, kind));
    CHECK(is_invalid({1, -1e-40f, 1}, kind));
    CHECK(kind == InvalidSample::Kind::negative);
    CHECK(is_invalid({1, kInfinity, -1}, kind));
    CHECK(is_invalid({-1, kInfinity, kNan}, kind));
    CHECK(kind == InvalidSample::Kind::nan);
    CHECK(std::string(name(InvalidSample::Kind::nan)) == "NaN");
}

TEST_CASE("D10: a scene made by hand with radiance that is no number or negative is refused or its samples counted", "[scenes]") {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -1.0f}) {
        const auto refused_or_counted = [&](const SceneDescription& d) {
            try {
                return Ready(d).render("random", 16, 1).stats.invalid_samples > 0;
            } catch (const Error&) {
                return true;
            }
        };
        SceneDescription area = empty_scene();
        add_shape(area, RectangleShape{}, scaled(5) * kUp, 0);
        add_light(area, RectangleShape{}, translated({0, 1, 0}) * kDown, Rgb(bad));
        area.camera.to_world = look_at({0, 0.5, 0.5}, {0, 0, 0});
        INFO("radiance " << bad);
        CHECK(refused_or_counted(area));
        SceneDescription sky = empty_scene();
        sky.environment = ConstantEnvironment{Rgb(bad), {}};
        CHECK(refused_or_counted(sky));
        SceneDescription point = area;
        point.shapes.pop_back();
        point.point_lights.push_back({{0, 1, 0}, Rgb(bad), {}});
        CHECK(refused_or_counted(point));
        SceneDescription map = area;
        map.shapes.pop_back();
        MapEnvironment m;
        m.image = image(4, 4, std::vector<Rgb>(16, Rgb(bad)));
        map.environment = m;
        CHECK(refused_or_counted(map));
    }
}
