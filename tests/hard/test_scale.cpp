// Scale, offset, self-intersection and watertightness.

#include <scenes/render_scene.h>

#include <koksma/sampling/error.h>
#include <koksma/scene/light_sampling.h>

#include <limits>

using namespace koksma;
using namespace koksma::testing;

namespace {

SceneDescription scaled_furnace(Geometry geometry, double radius, const Matrix& turn = Matrix(1.0)) {
    SceneDescription d = furnace(std::move(geometry), turn * scaled(radius), 0.5f, 1.0f);
    d.camera.near_clip = 1e-3 * radius;
    d.camera.far_clip = 1e3 * radius;
    d.camera.to_world = translated(glm::dvec3(0.1, -0.2, 0.05) * radius);
    return d;
}

const Matrix kTurn = rotated({0.6, 0.8, 0.0}, 37);

std::string compile_error(const SceneDescription& d) {
    try {
        (void)compile(d);
    } catch (const Error& e) {
        return e.what();
    }
    return {};
}

}  // namespace

TEST_CASE("B1: a furnace shows 2 down to a size of 1e-8", "[hard][render]") {
    for (const double radius : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
        INFO("radius " << radius);
        check_mean(measure(scaled_furnace(CubeShape{}, radius), 512, 8), 2.0, 3e-3);
        check_mean(measure(scaled_furnace(SphereShape{}, radius), 512, 8), 2.0, 3e-3);
    }
}

TEST_CASE("B2: a furnace shows 2 up to a size of 1e9", "[hard][render]") {
    for (const double radius : {1e6, 1e9}) {
        INFO("radius " << radius);
        check_mean(measure(scaled_furnace(CubeShape{}, radius), 1024, 8), 2.0, 1e-3);
        check_mean(measure(scaled_furnace(SphereShape{}, radius), 2048, 8), 2.0, 1e-3);
    }
}

TEST_CASE("B2: a furnace shows 2 at a size of 1e12, and a sphere beyond", "[hard][render]") {
    check_mean(measure(scaled_furnace(CubeShape{}, 1e12), 512, 8), 2.0, 3e-3);
    for (const double radius : {1e12, 1e15, 9e17}) {
        INFO("radius " << radius);
        check_mean(measure(scaled_furnace(SphereShape{}, radius), 512, 8), 2.0, 3e-3);
    }
}

// Embree's triangle test multiplies three coordinates; beyond the cube root of 3e38, 7e12, no ray with a finite far plane hits, in
// silence: 0 for 2 at both sizes.
TEST_CASE("B2: a mesh too large for Embree's arithmetic is refused or right", "[hard][render]") {
    for (const double radius : {1e13, 1e15}) {
        const SceneDescription d = scaled_furnace(CubeShape{}, radius);
        if (!compile_error(d).empty()) continue;
        INFO("radius " << radius);
        check_mean(measure(d, 512, 8), 2.0, 3e-3);
    }
}

TEST_CASE("B3: a furnace far from the world's origin shows 2", "[hard][render]") {
    for (const double offset : {1e3, 1e4, 1e5, 1e6, 1e7}) {
        SceneDescription d = furnace(CubeShape{}, translated(glm::dvec3(offset)), 0.5f, 1.0f);
        d.camera.to_world = translated(glm::dvec3(offset) + glm::dvec3(0.1, -0.2, 0.05));
        INFO("offset " << offset);
        check_mean(measure(d, 1024, 8), 2.0, 1e-3);
    }
}

TEST_CASE("B3: a furnace far from its camera shows 2", "[hard][render]") {
    // Re-centring does not help here; the near plane lies in the middle of the cube. Tolerances of the row without re-centring.
    for (const auto& [distance, tolerance] : {std::pair{1e3, 1e-3}, {1e4, 1e-3}, {1e5, 5e-3}}) {
        SceneDescription d = furnace(CubeShape{}, translated(glm::dvec3(0, 0, distance)) * kTurn, 0.5f, 1.0f);
        d.camera.to_world = look_at({0, 0, 0}, {0, 0, 1});
        d.camera.fov_x_degrees = 20.0 / distance;
        d.camera.near_clip = distance;
        INFO("distance " << distance);
        check_mean(measure(d, 1024, 8), 2.0, tolerance);
    }
}

// The origin of the scene is the camera, so a coordinate of such a wall is exactly 0, and so is the bound of its error: rays start in the wall.
// Embree's robust mode meets what lies at t = 0: -9 % before rays were made to begin after it.
TEST_CASE("B4: a wall in whose plane the camera lies is not met by rays that leave it", "[hard][render]") {
    for (const glm::dvec3& axis : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
        SceneDescription d = furnace(CubeShape{}, translated(axis), 0.5f, 1.0f);
        d.camera.to_world = look_at({0, 0, 0}, axis + glm::dvec3(0.1, 0.2, 0.05));
        d.camera.fov_x_degrees = 20;
        d.camera.near_clip = 1e-3;
        check_mean(measure(d, 1024, 8), 2.0, 1e-3);
    }
}

TEST_CASE("B4: a turned furnace shows 2 over fourteen decades", "[hard][render]") {
    for (const double radius : {1e-8, 1e-4, 1.0, 1e3, 1e6}) {
        INFO("radius " << radius);
        check_mean(measure(scaled_furnace(CubeShape{}, radius, kTurn), 512, 8), 2.0, 3e-3);
    }
}

TEST_CASE("B5: no ray to an edge of a closed cube gets out", "[hard]") {
    const glm::dvec3 from(0.31, -0.17, 0.23);
    for (const double scale : {1e-4, 1.0, 1e6})
        for (const double offset : {0.0, 10.0, 1000.0}) {
            SceneDescription d = empty_scene();
            add_shape(d, CubeShape{}, translated(glm::dvec3(offset * scale)) * scaled(scale), 0);
            // Not at the camera: the origin of the scene stays where it is.
            const Scene scene = compile(d);
            const Vec3f o = Vec3f(glm::vec3((from + offset) * scale));
            int misses = 0, packet_misses = 0;
            // The batch kernel's packets are other code of Embree's than single rays.
            RayPacket<8> packet{};
            int waiting = 0;
            const auto shoot_packet = [&] {
                alignas(32) std::int32_t valid[8];
                for (int i = 0; i < 8; ++i) valid[i] = i < waiting ? -1 : 0;
                scene.accelerator.intersect(packet, valid, Coherence::incoherent);
                for (int i = 0; i < waiting; ++i) packet_misses += packet.geometry[i] == Hit::kNone;
                waiting = 0;
            };
            const auto add_to_packet = [&](const Ray& ray) {
                const int i = waiting++;
                packet.o_x[i] = ray.o.x, packet.o_y[i] = ray.o.y, packet.o_z[i] = ray.o.z;
                packet.d_x[i] = ray.d.x, packet.d_y[i] = ray.d.y, packet.d_z[i] = ray.d.z;
                packet.t_near[i] = 0.0f, packet.t_far[i] = kInfinity, packet.mask[i] = ~0u;
                packet.geometry[i] = packet.instance[0][i] = packet.instance[1][i] = Hit::kNone;
                if (waiting == 8) shoot_packet();
            };
            const auto shoot = [&](glm::dvec3 to) {
                const Vec3f p = Vec3f(glm::vec3((to + offset) * scale));
                const Ray ray{o, normalize((p - o) * static_cast<float>(1.0 / scale))};
                misses += !scene.accelerator.intersect(ray).valid();
                add_to_packet(ray);
            };
            // 12 edges and the 12 diagonals of the faces: 400 008 rays.
            for (int axis = 0; axis < 3; ++axis)
                for (int k = 0; k < 16667; ++k) {
                    const double t = -1.0 + 2.0 * (k + 0.5) / 16667.0;
                    glm::dvec3 p;
                    p[axis] = t;
                    for (const double s1 : {-1.0, 1.0})
                        for (const double s2 : {-1.0, 1.0}) {
                            p[(axis + 1) % 3] = s1;
                            p[(axis + 2) % 3] = s2;
                            shoot(p);
                        }
                    for (const double s : {-1.0, 1.0})
                        for (const double sign : {-1.0, 1.0}) {  // one of the two is the edge that the triangles share
                            p[axis] = s;
                            p[(axis + 1) % 3] = t;
                            p[(axis + 2) % 3] = sign * t;
                            shoot(p);
                        }
                }
            shoot_packet();
            INFO("scale " << scale << " offset " << offset << " misses " << misses << ", in packets " << packet_misses);
            CHECK(misses == 0);
            CHECK(packet_misses == 0);
        }
}

TEST_CASE("B7: vertices that Embree's arithmetic would lose in silence are refused, those below that limit are hit", "[hard]") {
    const auto with_vertex = [](float x) {
        SceneDescription d = empty_scene();
        add_shape(d, RectangleShape{}, translated({0, 0, 3}), 0);
        add_shape(d, mesh({{0, 0, 5}, {1, 0, 5}, {x, 1, 5}}, {{0, 1, 2}}), Matrix(1.0), 0);
        return d;
    };
    CHECK_FALSE(compile_error(with_vertex(std::numeric_limits<float>::quiet_NaN())).empty());
    CHECK_FALSE(compile_error(with_vertex(std::numeric_limits<float>::infinity())).empty());
    CHECK_FALSE(compile_error(with_vertex(1e19f)).empty());
    CHECK_FALSE(compile_error(with_vertex(1e18f)).empty());
    const Scene scene = compile(with_vertex(1e12f));
    CHECK(scene.accelerator.intersect({{0, 0, 0}, {0, 0, 1}}).geometry == 0);
}

TEST_CASE("B7: spheres and disks that Embree would drop in silence are refused", "[hard]") {
    SceneDescription sphere = empty_scene();
    add_shape(sphere, SphereShape{}, scaled(1e19), 0);
    CHECK_FALSE(compile_error(sphere).empty());
    SceneDescription disk = empty_scene();
    add_shape(disk, DiskShape{}, translated({0, 0, 1e19}), 0);
    CHECK_FALSE(compile_error(disk).empty());
    SceneDescription nan = empty_scene();
    add_shape(nan, SphereShape{glm::dvec3(std::numeric_limits<double>::quiet_NaN()), 1.0}, Matrix(1.0), 0);
    CHECK_FALSE(compile_error(nan).empty());
}

TEST_CASE("B8: triangles without area are never hit and harm nothing", "[hard]") {
    SceneDescription d = empty_scene();
    add_shape(d,
              mesh({{0, 0, 2}, {0, 0, 2}, {0, 0, 2}, {-1, -1, 2}, {0, 0, 2}, {1, 1, 2}, {-1, 0, 3}, {1, 0, 3}, {1, 1e-7f, 3}, {-1, -1, 4}, {1, -1, 4}, {0, 1, 4}},
                   {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}),
              Matrix(1.0), 0);
    const Scene scene = compile(d);
    for (const float x : {0.0f, 1e-3f, -1e-3f})
        for (const float y : {0.0f, 1e-3f, -1e-3f}) {
            const Ray ray{{0, 0, 0}, normalize(Vec3f{x, y, 1})};
            const Hit hit = scene.accelerator.intersect(ray);
            REQUIRE(hit.valid());
            // A sliver of height 1e-7 may be hit: it has an area.
            CHECK(hit.primitive >= 2);
            const Surface s = surface_at<EffectSet::all()>(scene, ray, hit);
            CHECK(is_finite(s.p));
            CHECK(std::fabs(length(s.ng) - 1.0f) < 1e-6f);
        }
}

TEST_CASE("B9: rays that Embree may not see are kept from it", "[hard]") {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    CHECK(is_traceable<float>({1, 2, 3}, {0, 0, 1}));
    CHECK(is_traceable<float>({1, 2, 3}, {0, 0, 1e10f}));
    CHECK_FALSE(is_traceable<float>({1, 2, 3}, {0, 0, 0}));
    CHECK_FALSE(is_traceable<float>({1, 2, 3}, {kNan, 0, 1}));
    CHECK_FALSE(is_traceable<float>({1, kNan, 3}, {0, 0, 1}));
    CHECK_FALSE(is_traceable<float>({kInfinity, 2, 3}, {0, 0, 1}));
    CHECK_FALSE(is_traceable<float>({1, 2, 3}, {0, -kInfinity, 1}));
    // Embree's own check of a ray: |x| < 1.844e18, in debug builds an assertion.
    CHECK_FALSE(is_traceable<float>({1, 2, 3}, {0, 0, 2e18f}));
    CHECK_FALSE(is_traceable<float>({1, 2e18f, 3}, {0, 0, 1}));
}

TEST_CASE("B10: denormal geometry is missed and denormal light is lost without an error", "[hard][render]") {
    SceneDescription tiny = empty_scene();
    add_shape(tiny, CubeShape{}, scaled(1e-20), 0);
    tiny.environment = ConstantEnvironment{};
    tiny.camera.near_clip = 1e-24;
    const Measured m = measure(tiny, 64, 2);
    CHECK(m.invalid == 0);
    CHECK(m.mean <= 1.0);
    for (const float le : {1e-40f, 1e-38f}) {
        SceneDescription d = empty_scene();
        add_light(d, RectangleShape{}, translated({0, 1, 0}) * kDown, Rgb(le));
        add_shape(d, RectangleShape{}, scaled(5) * kUp, 0);
        look_narrowly(d, {0.3, 0.5, 0}, {0, 0, 0});
        const Measured dark = measure(d, 64, 2);
        INFO("Le " << le << " mean " << dark.mean);
        CHECK(dark.invalid == 0);
        CHECK(dark.mean <= 0.3e-38);
    }
}

TEST_CASE("B11: a camera inside a solid sphere sees nothing", "[hard][render]") {
    SceneDescription d = empty_scene();
    add_shape(d, SphereShape{}, Matrix(1.0), 0);
    d.environment = ConstantEnvironment{};
    CHECK(measure(d, 64, 2).mean == 0.0);
}

TEST_CASE("B12: near and far planes are those of the scene", "[hard][render]") {
    SceneDescription d = empty_scene();
    add_light(d, RectangleShape{}, scaled(5) * kUp, Rgb(1.0f));
    d.camera.to_world = look_at({0, 0.005, 0}, {0, 0, 0});
    d.camera.near_clip = 1e-5;
    CHECK(measure(d, 16, 2).mean == 1.0);
    d.camera.near_clip = 1e-2;
    CHECK(measure(d, 16, 2).mean == 0.0);
    d.camera.near_clip = 1e-5;
    d.camera.far_clip = 4e-3;
    CHECK(measure(d, 16, 2).mean == 0.0);
}
