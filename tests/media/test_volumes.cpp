// Values of volumes against a slow exact version.

#include <koksma/sampling/error.h>
#include <koksma/scene/load.h>

#include "media_scenes.h"

#include <scenes/uniform.h>

#include <glm/matrix.hpp>

#include <fstream>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// One channel at a point of the unit cube, straight from the definition: cell i is centred at (i + 1/2) / n.
double oracle(const VolumeGrid& g, GridVolume::Wrap wrap, bool nearest, glm::dvec3 q, int channel) {
    const auto index = [&](long i, int axis) {
        const long n = g.size[static_cast<std::size_t>(axis)];
        if (wrap == GridVolume::Wrap::clamp) return std::min(std::max(i, 0l), n - 1);
        if (wrap == GridVolume::Wrap::repeat) return ((i % n) + n) % n;
        const long r = ((i % (2 * n)) + 2 * n) % (2 * n);
        return r < n ? r : 2 * n - 1 - r;
    };
    const auto cell = [&](long x, long y, long z) {
        return static_cast<double>(g.values[static_cast<std::size_t>(
            ((index(z, 2) * g.size[1] + index(y, 1)) * g.size[0] + index(x, 0)) * g.channels + (g.channels == 1 ? 0 : channel))]);
    };
    const glm::dvec3 at = q * glm::dvec3(g.size[0], g.size[1], g.size[2]);
    if (nearest) return cell(static_cast<long>(std::floor(at.x)), static_cast<long>(std::floor(at.y)), static_cast<long>(std::floor(at.z)));
    double sum = 0;
    const glm::dvec3 low = glm::floor(at - 0.5);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 c = low + glm::dvec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::dvec3 w = 1.0 - glm::abs(at - 0.5 - c);
        sum += w.x * w.y * w.z * cell(static_cast<long>(c.x), static_cast<long>(c.y), static_cast<long>(c.z));
    }
    return sum;
}

}  // namespace

TEST_CASE("grids are interpolated and wrapped as their definition says", "[media]") {
    Uniform u(5);
    for (const int channels : {1, 3}) {
        std::vector<float> values(static_cast<std::size_t>(4 * 3 * 5 * channels));
        for (float& v : values) v = u();
        const auto g = grid(4, 3, 5, values);
        for (const auto wrap : {GridVolume::Wrap::clamp, GridVolume::Wrap::repeat, GridVolume::Wrap::mirror})
            for (const bool nearest : {false, true}) {
                SceneDescription d = volume_scene();
                d.camera.to_world = translated({0.7, -0.2, 3.0});
                Medium m = heterogeneous(g, translated({0.3, 0.1, -0.4}) * rotated({0.6, 0.8, 0}, 40) * scaled({1.5, 0.7, 2.0}), Rgb(0.5f));
                auto& v = std::get<GridVolume>(m.sigma_t);
                v.wrap = wrap;
                v.filter = nearest ? GridVolume::Filter::nearest : GridVolume::Filter::trilinear;
                add_medium(d, m, CubeShape{}, Matrix(1.0));
                const Scene scene = compile(d);
                REQUIRE(scene.media.size() == 1);
                const Matrix own = glm::inverse(v.to_world);
                double worst = 0;
                int steps = 0;
                for (int i = 0; i < 4000; ++i) {
                    const glm::dvec3 world(4 * u() - 2, 4 * u() - 2, 4 * u() - 2);
                    const glm::dvec3 q(own * glm::dvec4(world, 1.0));
                    const Vec3f got = value_at(scene.media[0].density, Vec3f(glm::vec3(world - glm::dvec3(d.camera.to_world[3]))));
                    const double error =
                        std::max({std::fabs(got.x - oracle(*g, wrap, nearest, q, 0)), std::fabs(got.y - oracle(*g, wrap, nearest, q, 1)),
                                  std::fabs(got.z - oracle(*g, wrap, nearest, q, 2))});
                    if (nearest && error > 1e-4)
                        ++steps;  // a point within rounding of a face between cells
                    else
                        worst = std::max(worst, error);
                }
                INFO("channels " << channels << " wrap " << static_cast<int>(wrap) << " nearest " << nearest << ": worst " << worst);
                CHECK(worst < 2e-5);
                CHECK(steps < 4);
                CHECK(max_component(largest_value(Volume(v))) == *std::max_element(values.begin(), values.end()));
            }
    }
}

TEST_CASE("a point so far that no fraction is left still has a value", "[media]") {
    for (const auto wrap : {GridVolume::Wrap::clamp, GridVolume::Wrap::repeat, GridVolume::Wrap::mirror}) {
        VolumeField f;
        f.grid = grid(2, 2, 2, {1, 2, 3, 4, 5, 6, 7, 8});
        f.wrap = wrap;
        f.rows[0] = {1, 0, 0}, f.rows[1] = {0, 1, 0}, f.rows[2] = {0, 0, 1};
        for (const float x : {1e9f, -1e20f, 3e37f}) {
            const Vec3f v = value_at(f, {x, -x, 0.5f * x});
            CHECK((v.x >= 1.0f && v.x <= 8.0f));
        }
    }
}

TEST_CASE("media that mean nothing are refused", "[media]") {
    const auto error = [](Medium m) -> std::string {
        SceneDescription d = volume_scene();
        m.where = {"a.xml", 3, 5};
        add_medium(d, std::move(m), CubeShape{}, Matrix(1.0));
        try {
            static_cast<void>(compile(d));
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    };
    const auto has = [](const std::string& text, const char* words) {
        INFO(text);
        CHECK(text.find("a.xml:3:5: ") == 0);
        CHECK(text.find(words) != std::string::npos);
    };
    has(error(homogeneous(Rgb(-1.0f), Rgb(0.5f))), "extinction");
    has(error(homogeneous(Rgb(std::nanf("")), Rgb(0.5f))), "extinction");
    has(error(homogeneous(Rgb(1.0f), Rgb(1.5f))), "albedo");
    has(error(homogeneous(Rgb(1.0f), Rgb(0.5f), 1.0)), "g of a medium");
    has(error(heterogeneous(grid(1, 1, 1, {1e7f}), Matrix(1.0), Rgb(0.5f))), "mean free paths");
    has(error(heterogeneous(grid(1, 1, 1, {1.0f}), scaled({1, 1, 0}), Rgb(0.5f))), "singular");
    Medium grid_in_homogeneous = heterogeneous(grid(1, 1, 1, {1.0f}), Matrix(1.0), Rgb(0.5f));
    grid_in_homogeneous.heterogeneous = false;
    has(error(grid_in_homogeneous), "must be constant");
    CHECK(error(homogeneous(Rgb(0.0f), Rgb(0.5f))) == "no error");
}

TEST_CASE("an empty medium calls for nothing", "[media]") {
    SceneDescription d = volume_scene();
    add_medium(d, homogeneous(Rgb(0.0f), Rgb(0.5f)), CubeShape{}, Matrix(1.0));
    CHECK_FALSE(compile(d).effects.has(Effect::medium));
}
