// Spots, directional lights and projectors against closed forms; cylinders against their own formulas.

#include "render_scene.h"

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr double kPiDouble = 3.14159265358979323846;

/// Radiance of a white floor at (x, 0, 0), lit by one light.
double seen(const DeltaLight& light, double x = 0.0) {
    SceneDescription d = empty_scene();
    add_shape(d, RectangleShape{}, scaled(50) * kUp, add_diffuse(d, 1.0f));
    d.delta_lights.push_back(light);
    look_narrowly(d, {x, 1, 0.5}, {x, 0, 0}, 1e-4);
    d.integrator.max_depth = 2;
    return Ready(d).render(kSobol, 4, 1).film.mean().y;
}

Matrix from_above(double height) { return look_at({0, height, 0}, {0, 0, 0}, {0, 0, 1}); }

}  // namespace

TEST_CASE("a spot lights the floor as its angle says", "[scenes]") {
    SpotLight s;
    s.to_world = from_above(2);
    s.intensity = Rgb(5.0f);
    s.cutoff_degrees = 40;
    s.beam_degrees = 20;
    for (const double degrees : {0.0, 10.0, 19.9, 25.0, 35.0, 39.9, 40.1, 60.0}) {
        const double a = degrees * kPiDouble / 180, distance = 2 / std::cos(a);
        const double falloff = degrees <= 20 ? 1.0 : degrees >= 40 ? 0.0 : (40 - degrees) / 20;
        const double expected = 5 * falloff * std::cos(a) / (distance * distance) / kPiDouble;
        INFO(degrees << " degrees");
        CHECK(std::fabs(seen(s, 2 * std::tan(a)) - expected) <= 2e-5);
    }
}

TEST_CASE("a directional light is as bright as its irradiance and the cosine", "[scenes]") {
    for (const double degrees : {0.0, 30.0, 80.0}) {
        const double a = degrees * kPiDouble / 180;
        const DirectionalLight light{glm::dvec3(std::sin(a), -std::cos(a), 0) * 7.0, Rgb(3.0f), {}};
        CHECK(std::fabs(seen(light, 4.0) - 3 * std::cos(a) / kPiDouble) <= 1e-5);
    }
    CHECK(seen(DirectionalLight{{0, 1, 0}, Rgb(3.0f), {}}) == 0.0);  // from below
}

TEST_CASE("a projector lights a plane before it evenly, and only where its picture falls", "[scenes]") {
    ProjectorLight p;
    p.to_world = from_above(1);
    p.fov_x_degrees = 90;
    p.scale = 0.5;
    // Irradiance pi * 0.5 at distance 1; a white diffuse surface has radiance irradiance / pi.
    for (const double x : {0.0, 0.5, -0.99}) CHECK(std::fabs(seen(p, x) - 0.5) <= 1e-5);
    CHECK(seen(p, 1.01) == 0.0);
    p.to_world = from_above(2);
    CHECK(std::fabs(seen(p, 1.5) - 0.125) <= 1e-5);
}

TEST_CASE("a cylinder is met where it is, from outside and from inside, and has no caps", "[scenes]") {
    const AnalyticCylinder c{{0, 0, 1}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0.5};
    const auto along_x = [&](float z, float x = -3.0f) { return intersect(c, Ray{{x, 0, z}, {1, 0, 0}}); };
    CHECK(along_x(2.0f).t == 2.5);
    CHECK(along_x(2.0f).along == 0.5);
    CHECK(along_x(2.0f).cosine == -1.0);
    CHECK(along_x(2.0f, 0.0f).t == 0.5);
    CHECK(along_x(0.9f).t == kInfinity);
    CHECK(along_x(3.1f).t == kInfinity);
    CHECK(intersect(c, Ray{{0.2f, 0, -3}, {0, 0, 1}}).t == kInfinity);  // through the tube
    const CylinderHit slanted = intersect(c, Ray{{0, 0, 0}, {0.25f, 0, 1}});  // in through the open end, to the inner wall
    CHECK(slanted.t == 2.0);
    CHECK(slanted.along == 0.5);
    CHECK(intersect(c, Ray{{-3, 0.6f, 2}, {1, 0, 0}}).t == kInfinity);
}
