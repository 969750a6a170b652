// Light from an image at infinity.

#include <scenes/render_scene.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// A floor of albedo 0.5 under a black sky with one bright texel.
SceneDescription floor_under_texel(int width, int height, int column, int row, float radiance) {
    SceneDescription d = empty_scene();
    add_shape(d, RectangleShape{}, scaled(1e3) * kUp, 0);
    look_narrowly(d, {0, 1, 0.5}, {0, 0, 0});
    std::vector<Rgb> texels(static_cast<std::size_t>(width) * height, Rgb(0.0f));
    if (row >= 0) texels[static_cast<std::size_t>(row) * width + column] = Rgb(radiance);
    MapEnvironment map;
    map.image = image(width, height, std::move(texels));
    d.environment = map;
    return d;
}

}  // namespace

TEST_CASE("D7: one bright texel gives the irradiance of its tent", "[hard][render]") {
    // By Mitsuba's convention, rows on the poles: 12.0303849. Measured there: 12.03038.
    check_mean(measure(floor_under_texel(512, 256, 100, 64, 1e6f), 4096, 8), 12.0303849, 1e-3);
}

TEST_CASE("D8: the seam of the map is like any other column", "[hard][render]") {
    const double at_seam = measure(floor_under_texel(512, 256, 0, 64, 1e6f), 4096, 8).mean;
    for (const int column : {1, 128, 256, 511}) {
        const Measured m = measure(floor_under_texel(512, 256, column, 64, 1e6f), 4096, 8);
        INFO("column " << column << " mean " << m.mean << " at the seam " << at_seam << " noise " << m.standard_error);
        CHECK(m.invalid == 0);
        CHECK(std::fabs(m.mean / at_seam - 1.0) <= 1e-5 + 2.0 * m.noise() / at_seam);
    }
}

TEST_CASE("D8: bright texels by the pole of a large map are not lost", "[hard][render]") {
    // A row of the tent next to the pole, in closed form: the irradiance of the ring is sum over cells of radiance cos omega.
    // Compared with the same ring in a map of a quarter of the columns: the tent in azimuth integrates to the same.
    const auto ring = [](int width, int height, int row) {
        SceneDescription d = floor_under_texel(width, height, 0, -1, 0.0f);
        std::vector<Rgb> texels(static_cast<std::size_t>(width) * height, Rgb(0.0f));
        for (int x = 0; x < width; ++x) texels[static_cast<std::size_t>(row) * width + x] = Rgb(1e4f);
        MapEnvironment map;
        map.image = image(width, height, std::move(texels));
        d.environment = map;
        return d;
    };
    const double dtheta = std::acos(-1.0) / 2047.0;
    for (const int row : {0, 1, 2, 5}) {
        // Integral of tent(theta) cos(theta) sin(theta) 2 pi d theta, by the midpoint rule.
        double irradiance = 0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < 2 * kSteps; ++i) {
            const double at = (i + 0.5) / kSteps - 1.0, theta = (row + at) * dtheta;
            if (theta > 0) irradiance += (1.0 - std::fabs(at)) * std::cos(theta) * std::sin(theta) * dtheta / kSteps;
        }
        const double expected = 1e4 * irradiance * 2.0 * 0.5;  // albedo 0.5 over pi, 2 pi of azimuth
        INFO("row " << row);
        check_mean(measure(ring(16, 2048, row), 4096, 8), expected, 5e-3);
    }
}

TEST_CASE("D9: a black map is dark and makes no NaN", "[hard][render]") {
    const Measured m = measure(floor_under_texel(16, 8, 0, -1, 0.0f), 256, 4);
    CHECK(m.mean == 0.0);
    CHECK(m.invalid == 0);
}
