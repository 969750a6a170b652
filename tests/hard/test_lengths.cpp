// Vectors whose squared length float cannot hold.

#include <koksma/scene/light_sampling.h>

#include <scene/scene_files.h>
#include <scenes/render_scene.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// A floor of albedo 0.5 seen straight from above.
SceneDescription floor_from_above() {
    SceneDescription d = empty_scene();
    add_shape(d, RectangleShape{}, scaled(10) * kUp, 0);
    look_narrowly(d, {0, 1, 0}, {0, 0, 0});
    return d;
}

}  // namespace

TEST_CASE("F6: a direction of length 0 is no ray", "[hard]") {
    CHECK_FALSE(is_traceable<float>({0, 0, 0}, {0, 0, 0}));
    // Squares that underflow: no direction either, rather than a NaN.
    CHECK_FALSE(is_traceable<float>({0, 0, 0}, {1e-30f, 0, 0}));
}

TEST_CASE("F6: a directional light of length 1e-30 or 1e30 shines as one of length 1", "[hard][render]") {
    for (const double length : {1e-30, 1.0, 1e30}) {
        SceneDescription d = floor_from_above();
        d.delta_lights.push_back(DirectionalLight{{0, -0.8 * length, 0.6 * length}, Rgb(static_cast<float>(std::acos(-1.0))), {}});
        INFO("length " << length);
        check_mean(measure(d, 64, 2), 0.5 * 0.8, 1e-6);
    }
}

TEST_CASE("F6: vertex normals of length 1e-30 or 1e30 are those of length 1", "[hard][render]") {
    for (const float length : {1e-30f, 1.0f, 1e30f}) {
        SceneDescription d = empty_scene();
        const glm::vec3 n = length * glm::vec3(0.6f, 0.8f, 0.0f);
        add_shape(d, mesh({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}, {{0, 1, 2}, {0, 2, 3}}, {n, n, n, n}), scaled(10), 0);
        d.delta_lights.push_back(DirectionalLight{{0, -1, 0}, Rgb(static_cast<float>(std::acos(-1.0))), {}});
        look_narrowly(d, {0, 1, 0}, {0, 0, 0});
        INFO("length " << length);
        check_mean(measure(d, 64, 2), 0.5 * 0.8, 1e-6);
    }
}

TEST_CASE("F6: normals that cancel out give way to the triangle's own", "[hard][render]") {
    const Vec3f up{0, 1, 0};
    CHECK(interpolated_normal<float>({1, 0, 0}, {-1, 0, 0}, up, 0.5f, {0.5f, 0.0f}, up).y == 1.0f);
    SceneDescription d = empty_scene();
    add_shape(d, mesh({{-1, 0, 0.5f}, {1, 0, 0.5f}, {0, 0, -1}}, {{0, 1, 2}}, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}), Matrix(1.0), 0);
    d.environment = ConstantEnvironment{};
    look_narrowly(d, {0, 1, 0.499}, {0, 0, 0.499}, 1e-4);
    check_mean(measure(d, 1024, 4), 0.5, 1e-2);
}

TEST_CASE("F6: directions and normals of length 0 are refused with their place", "[hard]") {
    const SceneFiles files;
    CHECK(files.error_of("<emitter type=\"directional\"><vector name=\"direction\" value=\"0, 0, 0\"/></emitter>").find("scene.xml:2:") !=
          std::string::npos);
    files.write("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nf 1//1 2//1 3//1\n");
    const std::string error = files.error_of("<shape type=\"obj\"><string name=\"filename\" value=\"zero.obj\"/></shape>");
    INFO(error);
    CHECK(error.find("zero.obj") != std::string::npos);
    CHECK(error.find("normal") != std::string::npos);
}
