// Light in media against closed forms.

#include "media_scenes.h"

#include <koksma/scene/medium/phase.h>

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

const Rgb kColoured(0.3f, 0.8f, 2.0f);

void check_rgb(const MeasuredRgb& got, Vec3d want, double relative) {
    const double w[3] = {want.x, want.y, want.z};
    for (int c = 0; c < 3; ++c) {
        INFO("channel " << c);
        check_mean(got.channel[c], w[c], relative);
    }
}

/// Looks along -y at a shining floor of radiance 2.
SceneDescription above_a_shining_floor(std::int32_t max_depth) {
    SceneDescription d = volume_scene(max_depth);
    add_light(d, RectangleShape{}, translated({0.1, -3, 0.2}) * scaled(50) * kUp, Rgb(2.0f));
    look_narrowly(d, {0.13, 4, 0.21}, {0.13, 0, 0.21}, 0.1);
    return d;
}

}  // namespace

TEST_CASE("an absorbing slab dims what is behind it by exp(-sigma d), colour by colour", "[media]") {
    SceneDescription d = above_a_shining_floor(1);
    add_medium(d, homogeneous(kColoured, Rgb(0.0f)), CubeShape{}, scaled({20, 0.6, 20}));
    check_rgb(measure_rgb(d, 4096), {2 * std::exp(-0.3 * 1.2), 2 * std::exp(-0.8 * 1.2), 2 * std::exp(-2.0 * 1.2)}, 3e-3);
}

TEST_CASE("a camera in a medium looks through what is before it", "[media]") {
    SceneDescription d = above_a_shining_floor(1);
    d.media.push_back(homogeneous(kColoured * 0.3f, Rgb(0.0f)));
    d.camera.medium = 0;
    check_rgb(measure_rgb(d, 4096), {2 * std::exp(-0.09 * 7), 2 * std::exp(-0.24 * 7), 2 * std::exp(-0.6 * 7)}, 3e-3);
    d.camera.near_clip = 2.0;  // rays start at the near clip, as in Mitsuba
    check_rgb(measure_rgb(d, 4096), {2 * std::exp(-0.09 * 5), 2 * std::exp(-0.24 * 5), 2 * std::exp(-0.6 * 5)}, 3e-3);
}

TEST_CASE("a grid that grows linearly dims by its integral", "[media]") {
    SceneDescription d = above_a_shining_floor(1);
    // Over y in [0, 2]: constant in the outer half cells, linear in between; the mean is the mean of the cells.
    Medium m = heterogeneous(grid(1, 4, 1, {0.0f, 0.5f, 1.0f, 1.5f}), translated({-20, 0, -20}) * scaled({40, 2, 40}), Rgb(0.0f));
    m.scale = 1.3;
    add_medium(d, m, CubeShape{}, translated({0, 1, 0}) * scaled({15, 1.5, 15}));
    const double t = 2 * std::exp(-1.3 * 2 * 0.75);
    check_rgb(measure_rgb(d, 65536), {t, t, t}, 3e-3);
}

TEST_CASE("a medium that absorbs nothing is not seen in a uniform sky", "[media]") {
    struct Case {
        const char* name;
        Medium medium;
        OneSidedMaterial boundary;
    };
    Medium cloud =
        heterogeneous(grid(2, 2, 2, {0.5f, 2.0f, 0.0f, 3.0f, 1.0f, 0.2f, 4.0f, 0.1f}), translated({-0.5, -0.5, -0.5}), Rgb(1.0f), 0.3);
    const Case cases[] = {{"grey", homogeneous(Rgb(3.0f), Rgb(1.0f)), Null{}},
                          {"coloured", homogeneous(kColoured, Rgb(1.0f), 0.6), Null{}},
                          {"grid", cloud, Null{}},
                          {"in glass", homogeneous(Rgb(1.0f), Rgb(1.0f)), Dielectric{}},
                          {"behind thin glass", homogeneous(kColoured, Rgb(1.0f), -0.5), ThinDielectric{}}};
    for (const Case& c : cases) {
        SceneDescription d = volume_scene();
        d.environment = ConstantEnvironment{Rgb(1.5f), {}};
        Shape& s = add_medium(d, c.medium, SphereShape{}, scaled(0.6));
        s.material = add_material(d, c.boundary);
        look_narrowly(d, {0, 0.2, 3}, {0, 0, 0}, 8);
        INFO(c.name);
        check_rgb(measure_rgb(d, 16384), {1.5, 1.5, 1.5}, 4e-3);
    }
}

TEST_CASE("one scattering in a slab under parallel light", "[media]") {
    for (const double g : {0.0, 0.5, -0.7})
        for (const bool as_grid : {false, true}) {
            // Light straight down, the camera looks down: sigma_s p E (1 - exp(-2 sigma d)) / (2 sigma).
            const double thickness = 1.2;
            const Rgb albedo(0.9f, 0.5f, 0.7f);
            SceneDescription d = volume_scene(2);
            const Matrix box = scaled({20, 0.5 * thickness, 20});
            std::vector<float> same;
            for (int i = 0; i < 8; ++i)
                for (int c = 0; c < 3; ++c) same.push_back(kColoured[c]);
            add_medium(d,
                       as_grid ? heterogeneous(grid(2, 2, 2, same), box * translated({-1, -1, -1}) * scaled(2), albedo, g)
                               : homogeneous(kColoured, albedo, g),
                       CubeShape{}, box);
            d.delta_lights.push_back(DirectionalLight{{0, -1, 0}, Rgb(3.0f), {}});
            look_narrowly(d, {0.13, 4, 0.21}, {0.13, 0, 0.21}, 0.1);
            const auto expected = [&](int c) {
                const double sigma = kColoured[c];
                return albedo[c] * static_cast<double>(eval_phase(static_cast<float>(g), 1.0f)) * 3 *
                       (1 - std::exp(-2 * sigma * thickness)) / 2;
            };
            INFO("g " << g << " grid " << as_grid);
            check_rgb(measure_rgb(d, 8192), {expected(0), expected(1), expected(2)}, 5e-3);
        }
}

TEST_CASE("a lamp shines through a medium by the medium's transmittance", "[media]") {
    for (const bool as_grid : {false, true}) {
        SceneDescription d = volume_scene(2);
        add_shape(d, RectangleShape{}, scaled(5) * kUp, 0);
        d.point_lights.push_back({{0.3, 3, 0.1}, Rgb(6.0f), {}});
        const Matrix box = translated({0, 1.5, 0}) * scaled({2, 0.5, 2});
        add_medium(d,
                   as_grid ? heterogeneous(grid(1, 1, 1, {0.8f}), box * translated({-1, -1, -1}) * scaled(2), Rgb(0.0f))
                           : homogeneous(kColoured, Rgb(0.0f)),
                   CubeShape{}, box);
        look_narrowly(d, {4, 0.5, 0}, {0, 0, 0}, 1e-3);
        const double d2 = 0.3 * 0.3 + 9 + 0.1 * 0.1, cosine = 3 / std::sqrt(d2), through = std::sqrt(d2) / 3;  // of a metre of height
        const double clear = 0.5 / std::numbers::pi * 6 * cosine / d2;
        const auto expected = [&](double sigma) { return clear * std::exp(-sigma * through); };
        INFO("grid " << as_grid);
        if (as_grid)
            check_rgb(measure_rgb(d, 65536), {expected(0.8), expected(0.8), expected(0.8)}, 3e-3);
        else
            check_rgb(measure_rgb(d, 64), {expected(kColoured.r), expected(kColoured.g), expected(kColoured.b)}, 1e-4);
    }
}

TEST_CASE("boundaries between equal media are not seen", "[media]") {
    const Medium fog = homogeneous(kColoured, Rgb(0.9f, 0.7f, 0.5f), 0.4);
    const auto scene = [&](int inner) {
        SceneDescription d = volume_scene();
        d.environment = ConstantEnvironment{Rgb(0.3f), {}};
        add_shape(d, RectangleShape{}, translated({0, -1.5, 0}) * scaled(4) * kUp, 0);
        add_light(d, RectangleShape{}, translated({0, 2.5, 0}) * scaled(0.7) * kDown, Rgb(4.0f));
        add_medium(d, fog, SphereShape{}, Matrix(1.0));
        if (inner > 0) {
            const std::uint32_t boundary =
                inner == 1 ? add_material(d, Null{}) : add_material(d, Dielectric{1.3f, 1.3f, Rgb(1.0f), Rgb(1.0f)});
            Shape& s = add_shape(d, CubeShape{}, rotated({0.6, 0, 0.8}, 33) * scaled(0.45), boundary);
            s.interior = s.exterior = 0;
        }
        look_narrowly(d, {0.3, 0.6, 4}, {0, -0.2, 0}, 30);
        return d;
    };
    const MeasuredRgb whole = measure_rgb(scene(0), 4096), null = measure_rgb(scene(1), 4096), matched = measure_rgb(scene(2), 8192);
    for (int c = 0; c < 3; ++c)
        for (const MeasuredRgb* other : {&null, &matched}) {
            const Measured &a = whole.channel[c], &b = other->channel[c];
            INFO("channel " << c << " whole " << a.mean << " +- " << a.standard_error << " cut " << b.mean << " +- " << b.standard_error);
            CHECK(std::fabs(a.mean - b.mean) <= std::hypot(a.noise(), b.noise()));
            CHECK(b.standard_error <= 0.01 * b.mean);
        }
}

TEST_CASE("a grid of one value is a homogeneous medium", "[media]") {
    const auto scene = [&](bool as_grid) {
        SceneDescription d = volume_scene();
        d.environment = ConstantEnvironment{Rgb(0.3f), {}};
        add_shape(d, RectangleShape{}, translated({0, -1.5, 0}) * scaled(4) * kUp, 0);
        add_light(d, SphereShape{}, translated({0.8, 1.6, 0.3}) * scaled(0.3), Rgb(9.0f));
        const Rgb albedo(0.9f, 0.7f, 0.5f);
        std::vector<float> same;
        for (int i = 0; i < 8; ++i)
            for (int c = 0; c < 3; ++c) same.push_back(kColoured[c]);
        add_medium(d,
                   as_grid ? heterogeneous(grid(2, 2, 2, same), translated({-1, -1, -1}) * scaled(2), albedo, 0.4)
                           : homogeneous(kColoured, albedo, 0.4),
                   CubeShape{}, scaled(0.9));
        look_narrowly(d, {0.3, 0.6, 4}, {0, -0.2, 0}, 30);
        return d;
    };
    const MeasuredRgb one = measure_rgb(scene(false), 4096), other = measure_rgb(scene(true), 4096);
    for (int c = 0; c < 3; ++c) {
        const Measured &a = one.channel[c], &b = other.channel[c];
        INFO("channel " << c << " homogeneous " << a.mean << " +- " << a.standard_error << " grid " << b.mean << " +- "
                        << b.standard_error);
        CHECK(std::fabs(a.mean - b.mean) <= std::hypot(a.noise(), b.noise()));
        CHECK(std::max(a.standard_error, b.standard_error) <= 0.01 * b.mean);
    }
}
