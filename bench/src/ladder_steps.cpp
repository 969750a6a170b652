// The ladders: which scene, how far, and what each should show.

#include "ladder.h"
#include "ladder_scenes.h"

#include <cmath>
#include <numbers>

namespace koksma {

namespace {

using namespace ladder;

constexpr double kPi64 = std::numbers::pi;
const std::vector<Technique> kAll{Technique::light, Technique::bsdf, Technique::mis};

/// Powers of ten from 10^a to 10^b.
std::vector<double> decades(int a, int b) {
    std::vector<double> out;
    for (int e = a; e != b; e += a < b ? 1 : -1) out.push_back(std::pow(10.0, e));
    out.push_back(std::pow(10.0, b));
    return out;
}

/// A floor of albedo 0.5 below a sphere that lights it by pi, whatever its size: 0.5.
SceneDescription floor_below_sphere(double solid_angle, double distance) {
    SceneDescription scene = floor_seen_from({0.3, 1, 1}, Diffuse{Rgb(0.5f)});
    const double ratio = std::sqrt(solid_angle / kPi64);
    add_light(scene, SphereShape{}, translated({0, distance, 0}) * scaled(ratio * distance), kPi64 / solid_angle);
    return scene;
}

Ladder light_size() {
    Ladder l{"light-size",
             "Size of a sphere light",
             "pi sin² of its half angle, in sr",
             "a sphere straight above lights a floor by pi Le sin²: radiance 0.5",
             1e-3,
             kAll,
             {}};
    for (const double omega : decades(0, -12)) l.steps.push_back({omega, floor_below_sphere(omega, 1.0), 0.5, 1 << 16});
    return l;
}

Ladder distance() {
    Ladder l{"distance", "Distance of a light of 0.01 sr", "distance in metres", "as above: 0.5 at every distance", 1e-3, kAll, {}};
    for (const double d : decades(0, 6)) l.steps.push_back({d, floor_below_sphere(1e-2, d), 0.5, 1 << 16});
    return l;
}

Ladder scale() {
    Ladder l{"scale", "Size of a furnace", "half side in metres", "Le / (1 - albedo) = 2", 3e-3, kAll, {}};
    for (const double half : decades(-8, 6)) l.steps.push_back({half, furnace(glm::dmat4(1.0), half, 0.5f, 1.0f), 2.0, 1024});
    return l;
}

Ladder offset() {
    Ladder l{
        "offset", "A furnace and its camera far from the origin", "offset along each axis in metres", "Le / (1 - albedo) = 2", 1e-3, kAll,
        {}};
    l.steps.push_back({0.1, furnace(glm::dmat4(1.0), 1.0, 0.5f, 1.0f), 2.0, 2048});  // 0, where a logarithm can show it
    for (const double o : decades(0, 7)) l.steps.push_back({o, furnace(translated(glm::dvec3(o)), 1.0, 0.5f, 1.0f), 2.0, 2048});
    return l;
}

Ladder camera_distance() {
    Ladder l{"camera-distance",
             "A furnace far from its camera",
             "distance in metres",
             "Le / (1 - albedo) = 2, seen through a near plane in the middle of the furnace",
             5e-3,
             kAll,
             {}};
    for (const double d : decades(0, 7)) {
        SceneDescription scene = furnace(translated({0, 0, d}), 1.0, 0.5f, 1.0f);
        scene.camera.to_world = look_at({0, 0, 0}, {0, 0, 1});
        scene.camera.fov_x_degrees = 20.0 / d;
        scene.camera.near_clip = d;
        scene.camera.far_clip = 1e9;
        l.steps.push_back({d, scene, 2.0, 1024});
    }
    return l;
}

/// Radiance of GGX with uncorrelated masking, F = 1, seen along the normal, under a disc of sky of radiance 1 with that half angle around
/// the normal. The facets' slopes are distributed as tan^2 = alpha^2 u / (1 - u): integral of G1 of the reflected direction over u, by the
/// midpoint rule. Source: Walter et al. 2007, equations 34 and 35
double highlight(double alpha, double half_angle) {
    const double t = std::tan(0.5 * half_angle), most = t * t / (alpha * alpha + t * t);
    constexpr int kSteps = 200000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double u = most * (i + 0.5) / kSteps, reflected = std::tan(2.0 * std::atan(alpha * std::sqrt(u / (1.0 - u))));
        sum += 2.0 / (1.0 + std::sqrt(1.0 + alpha * alpha * reflected * reflected));
    }
    return most * sum / kSteps;
}

Ladder roughness() {
    Ladder l{"roughness", "GGX that mirrors a sphere light of its own width",
             "alpha",     "one integral over facets, uncorrelated Smith masking",
             2e-3,        kAll,
             {}};
    for (double alpha : {1.0, 0.5, 0.2, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4}) {
        alpha = static_cast<float>(alpha);
        RoughConductor metal;
        metal.distribution = Facets::ggx;
        metal.alpha_u = metal.alpha_v = Rgb(static_cast<float>(alpha));
        // The camera is between floor and light, and casts no shadow.
        SceneDescription scene = floor_seen_from({0, 1, 0}, metal);
        const double sine = std::min(alpha, 0.8);
        add_light(scene, SphereShape{}, translated({0, 10, 0}) * scaled(10.0 * sine), 1.0);
        l.steps.push_back({alpha, scene, highlight(alpha, std::asin(sine)), 1 << 14});
    }
    return l;
}

Ladder albedo() {
    Ladder l{"albedo",
             "Albedo of a furnace",
             "1 - albedo",
             "Le / (1 - albedo) of the float albedo; random numbers, roulette from the fifth vertex",
             2e-2,
             kAll,
             {}};
    for (const double loss : {0.5, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4}) {
        const auto rho = static_cast<float>(1.0 - loss), le = static_cast<float>(loss);
        LadderStep step{loss, furnace(glm::dmat4(1.0), 1.0, rho, le), double{le} / (1.0 - double{rho}),
                        loss < 1e-3   ? 8u
                        : loss < 5e-3 ? 16u
                        : loss < 0.02 ? 64u
                                      : 256u};
        step.sampler = "random";
        l.steps.push_back(std::move(step));
    }
    return l;
}

Ladder grazing() {
    Ladder l{"grazing",
             "Light that grazes a floor",
             "cosine of incidence",
             "irradiance pi of a floor of albedo 0.5: 0.5 (no BSDF sample meets such a light)",
             1e-5,
             {Technique::light, Technique::mis},
             {}};
    for (const double c : decades(0, -12)) {
        SceneDescription scene = floor_seen_from({0.3, 1, 1}, Diffuse{Rgb(0.5f)});
        const double s = std::sqrt(1.0 - c * c);
        scene.delta_lights.push_back(DirectionalLight{{s, -c, 0}, Rgb(static_cast<float>(kPi64 / c)), {}});
        l.steps.push_back({c, scene, 0.5, 64, 0, 2});
    }
    return l;
}

/// A floor of albedo 0.5 one metre below the middle of a square lamp of two metres: 0.277063211989786.
SceneDescription floor_below_square() {
    SceneDescription scene = floor_seen_from({0.3, 1, 1}, Diffuse{Rgb(0.5f)});
    scene.camera.to_world = look_at(0.5 * glm::normalize(glm::dvec3(0.3, 1, 1)), {0, 0, 0});
    add_light(scene, RectangleShape{}, translated({0, 1, 0}) * facing_down(), 1.0);
    return scene;
}

Ladder sample_count(int most) {
    Ladder l{"spp", "Samples in one pixel", "samples", "a sky of 0.1, exactly", 1e-9, {Technique::mis}, {}};
    for (int e = 0; e <= most; e += e < 24 ? 3 : 1) {
        SceneDescription scene = empty_scene(1);
        scene.environment = ConstantEnvironment{Rgb(0.1f), {}};
        scene.integrator.max_depth = 1;
        l.steps.push_back({std::pow(2.0, e), scene, double{0.1f}, std::uint64_t{1} << e, 0, 2, "random"});
    }
    return l;
}

Ladder index() {
    Ladder l{"index",
             "Index of the first sample",
             "index",
             "form factor of a square lamp: 0.277063...; samplers in turn: sobol, halton, sobol-padded, random, around 2^32 all of them",
             1e-3,
             {Technique::mis},
             {}};
    const char* samplers[] = {"sobol:randomize=owen", "halton", "sobol-padded", "random"};
    const auto add = [&](double x, std::uint64_t first, const char* sampler) {
        l.steps.push_back({x, floor_below_square(), 0.277063211989786, 4096, first, 8, sampler});
    };
    int turn = 0;
    for (const int e : {0, 8, 16, 24, 31, 33, 36, 40}) add(std::pow(2.0, e), e == 0 ? 0 : std::uint64_t{1} << e, samplers[turn++ % 4]);
    // Half of the samples on either side of 2^32.
    for (int i = 0; i < 4; ++i) add(std::pow(2.0, 32) * (1.0 + 0.02 * i), (std::uint64_t{1} << 32) - 2048, samplers[i]);
    std::sort(l.steps.begin(), l.steps.end(), [](const LadderStep& a, const LadderStep& b) { return a.x < b.x; });
    return l;
}

}  // namespace

std::vector<Ladder> ladders(bool quick) {
    std::vector<Ladder> all{
        light_size(), distance(), scale(), offset(), camera_distance(), roughness(), albedo(), grazing(), sample_count(quick ? 21 : 25),
        index()};
    if (quick)
        for (Ladder& l : all)
            if (l.name != "spp" && l.name != "grazing")
                for (LadderStep& s : l.steps) s.spp = std::max<std::uint64_t>(s.spp / 16, 4);
    return all;
}

}  // namespace koksma
