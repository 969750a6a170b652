// Planes and spheres under a constant sky of radiance 1.

#include "under_sky.h"

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();

OneSidedMaterial rough(float alpha, RoughConductor::Distribution distribution = RoughConductor::Distribution::ggx) {
    RoughConductor r;
    r.distribution = distribution;
    r.alpha_u = r.alpha_v = Rgb(alpha);
    return r;
}

Dielectric glass(double index) {
    Dielectric g;
    g.int_ior = static_cast<float>(index);
    g.ext_ior = 1.0f;
    return g;
}

/// F + (1 - F) n^2: what a camera inside index n sees of a sky of 1 outside and 1 inside.
double from_inside(double degrees, double n) {
    const double ci = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees)) * n;
    if (s >= 1.0) return 1.0;
    const double ct = std::sqrt(1.0 - s * s);
    const double rs = (n * ci - ct) / (n * ci + ct), rp = (ci - n * ct) / (ci + n * ct);
    const double f = 0.5 * (rs * rs + rp * rp);
    return f + (1.0 - f) * n * n;
}

}  // namespace

TEST_CASE("C1: a white diffuse surface vanishes before a white sky", "[hard][render]") {
    SceneDescription d = empty_scene();
    const std::uint32_t white = add_diffuse(d, 1.0f);
    add_shape(d, SphereShape{}, Matrix(1.0), white);
    d.environment = ConstantEnvironment{};
    d.camera.fov_x_degrees = 35;
    d.camera.to_world = look_at({0, 0, -4}, {0, 0, 0});
    check_mean(measure(d, 512, 8), 1.0, 1e-3);
    check_mean(measure(plane_under_sky(Diffuse{Rgb(1.0f)}, 80, true), 4096, 8), 1.0, 1e-3);
}

TEST_CASE("C2: a mirror reflects the whole sky at every angle", "[hard][render]") {
    for (const double degrees : {0.0, 30.0, 60.0, 85.0, 89.0, 89.9, 89.99}) {
        SceneDescription d = plane_under_sky(Conductor{}, degrees);
        INFO("angle " << degrees);
        check_mean(measure(d, 16, 2), 1.0, 1e-6);
    }
}

TEST_CASE("C3: clear glass of any index vanishes before a white sky", "[hard][render]") {
    for (const double n : {1.0, 1.0 + 1e-7, 1.0 + 1e-6}) {
        INFO("index " << n);
        check_mean(measure(shape_under_sky(SphereShape{}, glass(n)), 64, 4), 1.0, 1e-6);
        check_mean(measure(shape_under_sky(CubeShape{}, glass(n)), 64, 4), 1.0, 1e-6);
    }
    for (const double n : {1.0001, 1.5, 2.4, 0.5}) {
        INFO("index " << n);
        check_mean(measure(shape_under_sky(SphereShape{}, glass(n)), 1024, 8), 1.0, 1e-3);
    }
    for (const double n : {1.5, 2.4}) {
        SceneDescription d = shape_under_sky(CubeShape{}, glass(n));
        d.integrator.max_depth = 512;  // a cube of glass holds some paths for ever
        INFO("cube of index " << n);
        check_mean(measure(d, 1024, 8), 1.0, 1e-3);
    }
}

TEST_CASE("C4: radiance in glass is larger by the square of the index, and nothing gets in beyond the critical angle", "[hard][render]") {
    for (const double n : {1.5, 2.4}) {
        SceneDescription d = shape_under_sky(SphereShape{}, glass(n));
        d.camera.to_world = look_at({0.3, 0, 0}, {0.3, 0.2, 1});
        INFO("index " << n);
        check_mean(measure(d, 2048, 8), n * n, 2e-3);
    }
    // At 0.9 of the radius all rays in the plane of the circle meet the surface at sin > 1 / 1.5, for ever: a limit is needed.
    SceneDescription trapped = shape_under_sky(SphereShape{}, glass(1.5));
    look_narrowly(trapped, {0.9, 0, 0}, {0.9, 0, 1});
    trapped.integrator.max_depth = 1000;
    CHECK(measure(trapped, 16, 2).mean == 0.0);
}

TEST_CASE("C5: from inside glass, up to the edge of total reflection", "[hard][render]") {
    for (const double degrees : {30.0, 41.0, 41.7, 41.8, 41.81, 41.9, 60.0, 89.0}) {
        SceneDescription d = plane_under_sky(glass(1.5), degrees);
        const double a = glm::radians(degrees);
        look_narrowly(d, {std::sin(a), -std::cos(a), 0}, {0, 0, 0}, 1e-7);
        INFO("angle " << degrees);
        check_mean(measure(d, 4096, 8), from_inside(degrees, 1.5), 3e-3);
    }
    // The catalogue's own numbers, to show that the formula above is not a copy of the code under test.
    CHECK(from_inside(30.0, 1.5) == Approx(2.18101229088).epsilon(1e-9));
    CHECK(from_inside(41.7, 1.5) == Approx(1.38792418957).epsilon(1e-8));
    CHECK(from_inside(41.81, 1.5) == Approx(1.02518079359).epsilon(1e-6));
}

TEST_CASE("C6: GGX with uncorrelated masking has the single-scattering albedo of its model", "[hard][render]") {
    struct Row {
        float alpha;
        double at_0, at_60, at_85;
    };
    for (const Row& row : {Row{0.01f, 1.0, 0.99979, 0.99222}, Row{0.1f, 0.98831, 0.96911, 0.87313}, Row{0.3f, 0.87736, 0.81813, 0.84700},
                           Row{0.5f, 0.68785, 0.68601, 0.77720}, Row{0.7f, 0.50372, 0.56581, 0.69215}, Row{1.0f, 0.30685, 0.40914, 0.56451}}) {
        for (const auto& [degrees, expected] : {std::pair{0.0, row.at_0}, {60.0, row.at_60}, {85.0, row.at_85}}) {
            INFO("alpha " << row.alpha << " angle " << degrees);
            check_mean(measure(plane_under_sky(rough(row.alpha), degrees), 2048, 8), expected, 3e-3);
        }
    }
}

TEST_CASE("C7: GGX of roughness 1e-3 and 1e-4 loses nothing", "[hard][render]") {
    for (const float alpha : {1e-3f, 1e-4f})
        for (const double degrees : {0.0, 60.0, 85.0}) {
            INFO("alpha " << alpha << " angle " << degrees);
            check_mean(measure(plane_under_sky(rough(alpha), degrees), 1024, 8), 1.0, 2e-3);
        }
}

TEST_CASE("C8: the peak of GGX is 1 / (pi alpha^2) and falls off in time", "[hard]") {
    for (const double alpha : {1e-1, 1e-2, 1e-3, 1e-4, 1e-10}) {
        const Microfacet m{static_cast<float>(alpha), static_cast<float>(alpha), true};
        INFO("alpha " << alpha);
        CHECK(static_cast<double>(m.d({0, 0, 1})) == Approx(1.0 / (std::numbers::pi * alpha * alpha)).epsilon(1e-5));
    }
    // One float below the pole; the textbook form gives 223991 here.
    const double c = 1.0 - 0x1p-24, s = std::sqrt(1.0 - c * c);
    const Microfacet m{1e-4f, 1e-4f, true};
    CHECK(static_cast<double>(m.d({static_cast<float>(s), 0, static_cast<float>(c)})) == Approx(190661.0).epsilon(2e-5));
}

TEST_CASE("C9: a highlight depends on the light's solid angle over alpha squared alone", "[hard][render]") {
    // 30 degrees from the normal; the light is a sphere in the mirror direction. Where masking is 1 the answer is the GGX
    // probability of the ellipse of slopes that reflect to it, with semi-axes theta / 2 and theta / (2 cos 30 deg):
    // the mean over the circle of r^2 / (1 + r^2) is 1 / sqrt((1 + 4 pi / ratio) (1 + 4 pi cos^2(30 deg) / ratio)).
    for (const double ratio : {1e4, 1e2, 1.0, 1e-2})
        for (const double alpha : {1e-4, 1e-3}) {
            const double k = 4.0 * std::numbers::pi / ratio, expected = 1.0 / std::sqrt((1.0 + k) * (1.0 + 0.75 * k));
            SceneDescription d = plane_under_sky(rough(static_cast<float>(alpha)), 30);
            d.environment.reset();
            look_narrowly(d, {0.5, std::sqrt(0.75), 0}, {0, 0, 0}, 1e-6);
            const double radius = std::sqrt(ratio * alpha * alpha / std::numbers::pi);
            add_light(d, SphereShape{}, translated({-0.5, std::sqrt(0.75), 0}) * scaled(radius), Rgb(1.0f));
            INFO("ratio " << ratio << " alpha " << alpha);
            check_mean(measure(d, 4096, 8), expected, 2e-3);
        }
}

TEST_CASE("C13: shading normals that point elsewhere make neither light nor NaN", "[hard][render]") {
    const auto quad = [](glm::vec3 normal) {
        return mesh({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, {{0, 1, 2}, {0, 2, 3}}, {normal, normal, normal, normal});
    };
    const auto scene_of = [&](glm::vec3 normal, OneSidedMaterial material, bool two_sided) {
        SceneDescription d = empty_scene();
        const std::uint32_t m = add_material(d, std::move(material), two_sided);
        add_shape(d, quad(normal), scaled(1e3), m);
        d.environment = ConstantEnvironment{};
        look_narrowly(d, {0, 1, 0}, {0, 0, 0});
        return d;
    };
    const Diffuse white{Rgb(1.0f)};
    CHECK(measure(scene_of({0, -1, 0}, white, false), 256, 2).mean == 0.0);
    CHECK(measure(scene_of({0, -1, 0}, Conductor{}, false), 256, 2).mean == 0.0);
    check_mean(measure(scene_of({0, -1, 0}, white, true), 4096, 8), 1.0, 1e-3);
    for (const double tilt : {60.0, 89.9}) {
        const double a = glm::radians(tilt);
        const glm::vec3 n(static_cast<float>(std::sin(a)), static_cast<float>(std::cos(a)), 0.0f);
        for (const OneSidedMaterial& material : {OneSidedMaterial(white), rough(0.1f), rough(0.5f), OneSidedMaterial(Conductor{}), OneSidedMaterial(glass(1.5))}) {
            const Measured m = measure(scene_of(n, material, false), 4096, 8);
            INFO("tilt " << tilt << " material " << material.index() << " mean " << m.mean << " invalid " << m.invalid);
            CHECK(m.invalid == 0);
            CHECK(m.mean <= 1.005 + m.noise());
        }
    }
}

TEST_CASE("C14: grazing light is not cut off by a threshold", "[hard]") {
    // There is no directional light; the BSDF alone: irradiance pi / c under cosine c on albedo 0.5 is radiance 0.5.
    Bsdf b;
    b.kind = BsdfKind::diffuse;
    b.reflectance = Vec3f(0.5f);
    for (const float c : {1e-6f, 1e-8f, 1e-10f, 1e-12f}) {
        const BsdfValue v = eval_bsdf<kAll>(b, {0, 0, 1}, {std::sqrt(1.0f - c * c), 0, c});
        CHECK(v.f_cos.x * kPi / c == Approx(0.5f).epsilon(1e-5));
    }
}

// Without a limit the path ends after 1 512 449 vertices, when rounding lets it out, half a second later: survival is beta times the
// square of the index, here exactly 1.
TEST_CASE("C4: a path that is trapped in glass comes to an end by itself", "[hard][render]") {
    SceneDescription d = shape_under_sky(SphereShape{}, glass(1.5));
    look_narrowly(d, {0.9, 0, 0}, {0.9, 0, 1});
    d.integrator.max_depth = 100000;
    const RenderStats stats = Ready(d).render("random", 1, 1).stats;
    INFO("vertices " << stats.rays.closest);
    CHECK(stats.rays.closest < 100000);
}
