// Instances: where their points are, that rays leave them, and that they look like the shapes themselves.

#include <scenes/render_scene.h>

#include <koksma/integrators/float_mode.h>
#include <koksma/sampling/error.h>
#include <koksma/scene/surface.h>

#include <random>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();

/// Turns, stretches by up to 30 to 1, mirrors, and moves by up to 300.
Matrix random_placement(std::mt19937_64& rng) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const auto axis = [&] { return glm::normalize(glm::dvec3(u(rng), u(rng), u(rng) + 2.0)); };
    const auto stretch = [&] { return std::copysign(std::exp(1.7 * u(rng)), u(rng)); };
    return translated(glm::dvec3(u(rng), u(rng), u(rng)) * std::pow(10.0, 2.5 * std::fabs(u(rng)))) * rotated(axis(), 180 * u(rng)) *
           scaled({stretch(), stretch(), stretch()}) * rotated(axis(), 180 * u(rng));
}

Vec3f random_direction(std::mt19937_64& rng) {
    std::normal_distribution<double> g;
    const glm::dvec3 d = glm::normalize(glm::dvec3(g(rng), g(rng), g(rng)));
    return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

}  // namespace

TEST_CASE("a ray that leaves a convex instance does not meet it, and one that enters does", "[effects]") {
    const FlushDenormals flush;
    std::mt19937_64 rng(1);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::uint64_t outward = 0, inward = 0, met_again = 0, missed = 0, through = 0, outside_bound = 0;
    for (int trial = 0; trial < 400; ++trial) {
        SceneDescription d = empty_scene();
        const bool cube = trial % 2 == 0;
        // A group that is not at its own origin.
        SceneDescription group = empty_scene();
        const Matrix own = translated({3, -2, 5}) * scaled(0.5);
        add_shape(group, cube ? Geometry(CubeShape{}) : Geometry(SphereShape{}), own, 0);
        d.groups.push_back({"g", group.shapes, {}});
        const Matrix place = random_placement(rng);
        d.instances.push_back({0, place, {}, {}});
        if (trial % 4 >= 2) {
            d.instances[0].animation = {{0.0, place}, {1.0, translated({1, 2, 3}) * place * rotated({0, 1, 0}, 30)}};
            d.camera.shutter_close = 1.0;
        }
        const Scene scene = compile(d);
        for (int i = 0; i < 100; ++i) {
            const auto time = static_cast<float>(0.5 + 0.499 * u(rng));
            // Toward a point inside, from far away.
            const Transfer transfer = transfer_at(scene, scene.instances[0], time);
            const Vec3f target = to_float(point_by(transfer.to_scene, {0.3 * u(rng), 0.3 * u(rng), 0.3 * u(rng)}));
            const Vec3f from = target + random_direction(rng) * 50.0f;
            const Ray ray{.o = from, .d = target - from, .time = time};
            const Hit hit = closest_hit<kAll>(scene, ray);
            if (!hit.valid()) continue;  // the camera was inside
            REQUIRE(hit.instance == 0);
            REQUIRE(hit.geometry == 0);
            const Surface s = surface_at<kAll>(scene, ray, hit);
            // The point itself is on the shape, up to its bound.
            const Vec3d q = point_by(transfer.to_own, to_double(s.p)), bound = bound_by(transfer.to_own, to_double(s.p_error));
            const double off = cube ? std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)}) - 0.5 : length(q) - 0.5;
            outside_bound += std::fabs(off) > length(bound);
            for (int k = 0; k < 10; ++k) {
                const Vec3f w = random_direction(rng);
                const bool out = dot(w, s.ng) * dot(ray.d, s.ng) < 0.0f;  // to the side that the ray came from
                const Ray next{.o = offset_origin(s.p, s.p_error, s.ng, w), .d = w, .time = time};
                const Hit met = closest_hit<kAll>(scene, next);
                ++(out ? outward : inward);
                met_again += out && met.valid();
                // Next to an edge the way inside may be shorter than the bound. A ray that starts inside must find its way out.
                const Vec3d start = point_by(transfer.to_own, to_double(next.o));
                const double distance = cube ? std::max({std::fabs(start.x), std::fabs(start.y), std::fabs(start.z)}) : length(start);
                const bool inside = !out && distance < 0.5 - 1e-6;
                through += inside;
                missed += inside && !met.valid();
            }
        }
    }
    INFO(outward << " outward, " << met_again << " met again; " << inward << " inward, " << through << " from inside, " << missed << " missed; " << outside_bound << " points outside their bounds");
    CHECK(outward > 100'000);
    CHECK(inward > 100'000);
    CHECK(met_again == 0);
    CHECK(static_cast<double>(through) > 0.95 * static_cast<double>(inward));
    CHECK(missed == 0);
    CHECK(outside_bound == 0);
}

TEST_CASE("instances look like the shapes themselves, placed one by one", "[effects]") {
    const std::vector<Matrix> places{translated({-1.2, 0, 0}), translated({1.2, 0.1, 0.4}) * rotated({0, 1, 0}, 40) * scaled({0.6, 1.4, 0.8}),
                                     translated({0, 0, -0.8}) * rotated({0, 0.6, 0.8}, 30) * scaled({-0.7, 0.9, 0.6})};
    SceneDescription d = empty_scene(24, 16);
    d.camera.to_world = look_at({0.5, 2, 5}, {0, 0.3, 0});
    d.camera.fov_x_degrees = 50;
    d.integrator.max_depth = 5;
    d.environment = ConstantEnvironment{Rgb(0.3f), {}};
    add_shape(d, RectangleShape{}, scaled(4) * kUp, 0);
    add_light(d, RectangleShape{}, translated({1, 3, 1}) * scaled(0.5) * kDown, Rgb(8.0f));
    RoughConductor brushed;
    brushed.alpha_u = Rgb(0.5f);
    brushed.alpha_v = Rgb(0.15f);
    const std::uint32_t metal = add_material(d, brushed, true), checks = add_material(d, Diffuse{CheckerboardTexture{}}, true);
    SceneDescription group = empty_scene();
    add_shape(group, CubeShape{}, translated({0, 0.3, 0}) * scaled(0.3), checks);
    add_shape(group, RectangleShape{}, translated({0.5, 0.4, 0.2}) * rotated({0, 1, 0}, 20) * scaled(0.25), metal);
    add_shape(group, DiskShape{}, translated({-0.5, 0.4, 0.2}) * rotated({1, 0, 0}, -30) * scaled(0.25), checks);
    SceneDescription one_by_one = d;
    d.groups.push_back({"g", group.shapes, {}});
    for (const Matrix& m : places) {
        d.instances.push_back({0, m, {}, {}});
        for (Shape s : group.shapes) {
            s.to_world = m * s.to_world;
            one_by_one.shapes.push_back(s);
        }
    }
    const Ready a(d), b(one_by_one);
    REQUIRE(a.plan.effects.has(Effect::instancing));
    REQUIRE_FALSE(b.plan.effects.has(Effect::instancing));
    const Measured x = measure(a, 64), y = measure(b, 64, 8, kSobol, 101);
    INFO(x.mean << " +- " << x.standard_error << " against " << y.mean << " +- " << y.standard_error);
    CHECK(std::fabs(x.mean - y.mean) <= x.noise() + y.noise());
    // With the same numbers nearly all paths are the same.
    const Film fa = a.render(kSobol, 16, 7).film, fb = b.render(kSobol, 16, 7).film;
    int far = 0;
    for (std::int32_t p = 0; p < 24 * 16; ++p) far += std::fabs(fa.mean({p % 24, p / 24}).y - fb.mean({p % 24, p / 24}).y) > 0.02 * fb.mean({p % 24, p / 24}).y;
    INFO(far << " of 384 pixels differ by more than 2 %");
    CHECK(far <= 20);
}

TEST_CASE("a group cannot emit", "[effects]") {
    SceneDescription d = empty_scene(), group = empty_scene();
    add_light(group, SphereShape{}, Matrix(1.0), Rgb(1.0f));
    d.groups.push_back({"g", group.shapes, {}});
    d.materials = group.materials;
    d.instances.push_back({0, Matrix(1.0), {}, {}});
    CHECK_THROWS_AS(compile(d), Error);
}
