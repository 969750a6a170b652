// Furnaces, series, truncation and roulette. A furnace of albedo rho and emission Le shows Le / (1 - rho) everywhere.

#include <scenes/render_scene.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr std::int32_t kNoRoulette = 1 << 20;

/// A closed cube of mirrors that shine.
SceneDescription mirror_cube(float a, float le) {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.0f, le);
    Conductor mirror;
    mirror.specular_reflectance = Rgb(a);
    d.shapes[0].material = add_material(d, mirror);
    return d;
}

}  // namespace

TEST_CASE("A1: a cube of albedo 0.5 that emits 1 shows 2", "[hard][render]") {
    const Ready ready(furnace(CubeShape{}, Matrix(1.0), 0.5f, 1.0f));
    check_mean(measure(ready, 2048, 8, kSobol), 2.0, 1e-3);
    check_mean(measure(ready, 2048, 8, "random"), 2.0, 1e-3);
}

TEST_CASE("A2: max_depth N truncates the series to N terms", "[hard][render]") {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.5f, 1.0f);
    d.integrator.rr_depth = kNoRoulette;
    for (const int n : {1, 2, 3, 6, 11}) {
        INFO("max_depth " << n);
        d.integrator.max_depth = n;
        check_mean(measure(d, 2048, 8), (1.0 - std::pow(0.5, n)) / 0.5, 1e-3);
    }
    d = furnace(CubeShape{}, Matrix(1.0), 0.99f, 0.01f);
    d.integrator.rr_depth = kNoRoulette;
    d.integrator.max_depth = 64;
    check_mean(measure(d, 256, 8), 1.0 - std::pow(0.99, 64), 1e-3);
    d.integrator.max_depth = 0;
    CHECK(measure(d, 16, 2).mean == 0.0);
}

TEST_CASE("A3: roulette keeps its mean and its variance at albedo 0.99", "[hard][render]") {
    // The relative standard deviation of a path is 0.995 with survival beta: 0.4 % at 65536 paths. A cap of 0.95 would make the
    // variance infinite, and the mean of most runs low by 10 %.
    const SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.99f, 0.01f);
    const Measured m = measure(d, 512, 8, "random");
    check_mean(m, 1.0, 2e-2);
    CHECK(m.highest - m.lowest < 0.1);
}

TEST_CASE("A4: survival beta from the first bounce on has the geometric law's variance", "[hard][render]") {
    // With beta back at 1 after each survival a path's value is its number of vertices: variance a / (1 - a)^2.
    for (const float a : {0.5f, 0.9f}) {
        SceneDescription d = mirror_cube(a, 1.0f);
        d.film.width = d.film.height = 512;
        d.integrator.rr_depth = 0;
        const Ready ready(d);
        const Film film = ready.render("random", 1, 7).film;
        double mean = 0, square = 0;
        for (std::int32_t y = 0; y < 512; ++y)
            for (std::int32_t x = 0; x < 512; ++x) {
                const double v = film.mean({x, y}).y / (512.0 * 512.0);
                mean += v;
                square += v * v * 512.0 * 512.0;
            }
        INFO("a " << a << " mean " << mean << " variance " << square - mean * mean);
        // 262144 paths: the relative standard error of the variance is sqrt((kurtosis - 1) / n) = 0.55 %.
        CHECK(std::fabs(mean * (1.0 - a) - 1.0) < 0.01);
        CHECK(std::fabs((square - mean * mean) * (1.0 - a) * (1.0 - a) / a - 1.0) < 0.02);
    }
}

TEST_CASE("A6: roulette sees what a path inside glass carries without the square of the index", "[hard][render]") {
    // From inside n = 2.4 beta reaches 5.76; a roulette that took it for 1 would have to stop paths at random.
    SceneDescription d = empty_scene();
    Dielectric glass;
    glass.int_ior = 2.4f;
    glass.ext_ior = 1.0f;
    const std::uint32_t material = add_material(d, glass);
    add_shape(d, SphereShape{}, Matrix(1.0), material);
    d.environment = ConstantEnvironment{};
    d.camera.to_world = look_at({0.2, 0, 0}, {0.2, 0.3, 1});
    d.integrator.rr_depth = 1;
    check_mean(measure(d, 4096, 8), 5.76, 1e-3);
}

TEST_CASE("A7: a cube of shining mirrors sums the geometric series", "[hard][render]") {
    SceneDescription d = mirror_cube(0.9f, 1.0f - 0.9f);
    d.integrator.rr_depth = kNoRoulette;
    check_mean(measure(d, 16, 4), 1.0, 1e-6);
    d = mirror_cube(0.99f, 1.0f - 0.99f);
    d.integrator.rr_depth = kNoRoulette;
    d.integrator.max_depth = 500;
    // The albedo as a float, since its 500th power shows.
    const double a = 0.99f;
    check_mean(measure(d, 16, 4), 1.0 - std::pow(a, 500), 1e-6);
    d.integrator = {};
    check_noise(measure(d, 512, 8), 1.0, 0.02);
}

TEST_CASE("A8: two mirrors that face each other, one of which shines", "[hard][render]") {
    for (const float a : {0.5f, 0.9f}) {
        SceneDescription d = empty_scene();
        Conductor mirror;
        mirror.specular_reflectance = Rgb(a);
        const std::uint32_t material = add_material(d, mirror);
        add_shape(d, RectangleShape{}, translated({0, 0, -1}), material).emission = AreaEmission{Rgb(1.0f), {}};
        add_shape(d, RectangleShape{}, translated({0, 0, 1}) * rotated({1, 0, 0}, 180), material);
        look_narrowly(d, {0, 0, 0}, {0, 0, -1});
        INFO("a " << a);
        check_noise(measure(d, 8192, 8), 1.0 / (1.0 - double{a} * a), 0.01);
    }
}

TEST_CASE("A9: a sphere that is lit by itself shows 2, wherever it stands", "[hard][render]") {
    for (const double o : {0.0, 1.0, 10.0, 100.0, 1000.0}) {
        SceneDescription d = furnace(SphereShape{}, translated(glm::dvec3(o)), 0.5f, 1.0f);
        d.camera.to_world = translated({o + 0.1, o, o});
        INFO("centre " << o);
        check_mean(measure(d, 1024, 8), 2.0, 4e-3);
    }
}
