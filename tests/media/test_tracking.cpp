// Flights and transmittances: their means against integrals.

#include <koksma/scene/medium/tracking.h>

#include "media_scenes.h"

#include <scenes/chi_squared.h>
#include <scenes/uniform.h>

#include <numeric>

using namespace koksma;
using namespace koksma::testing;

namespace {

MediumRecord homogeneous_record(Vec3f sigma_t, Vec3f albedo) {
    MediumRecord m;
    m.sigma_t = sigma_t;
    m.grey = sigma_t.x == sigma_t.y && sigma_t.x == sigma_t.z;
    m.albedo.constant = albedo;
    return m;
}

/// A coloured grid of 4 x 1 x 1 cells over [0, 4] x [0, 1]^2.
Scene coloured_grid() {
    SceneDescription d = volume_scene();
    std::vector<float> values{0.1f, 0.9f, 0.0f, 1.5f, 0.2f, 0.1f, 0.3f, 0.8f, 0.6f, 0.7f, 0.0f, 1.1f};
    add_medium(d, heterogeneous(grid(4, 1, 1, values), scaled({4, 1, 1}), Rgb(0.9f, 0.5f, 0.2f)), CubeShape{}, Matrix(1.0));
    return compile(d);
}

/// Exact depth of the coloured grid from x = a to b, y = z = 1/2: by a fine midpoint rule over the interpolated values.
Vec3d depth(const MediumRecord& m, double a, double b) {
    constexpr int kSteps = 20000;
    Vec3d sum;
    for (int i = 0; i < kSteps; ++i)
        sum = sum + to_double(value_at(m.density, {static_cast<float>(a + (b - a) * (i + 0.5) / kSteps), 0.5f, 0.5f})) * ((b - a) / kSteps);
    return sum;
}
Vec3d attenuated(Vec3d d) { return {std::exp(-d.x), std::exp(-d.y), std::exp(-d.z)}; }

struct Mean {
    double sum = 0, squares = 0;
    int n = 0;
    void add(double x) { sum += x, squares += x * x, ++n; }
    [[nodiscard]] double mean() const { return sum / n; }
    [[nodiscard]] double error() const { return std::sqrt(std::max(0.0, squares / n - mean() * mean()) / n); }
};
void check_near(const Mean (&got)[3], Vec3d want) {
    const double w[3] = {want.x, want.y, want.z};
    for (int c = 0; c < 3; ++c) {
        INFO("channel " << c << ": " << got[c].mean() << " +- " << got[c].error() << ", expected " << w[c]);
        CHECK(std::fabs(got[c].mean() - w[c]) <= 5 * got[c].error() + 1e-5 * std::fabs(w[c]) + 1e-9);
        CHECK(got[c].error() <= 0.02 * w[c]);
    }
}
void add(Mean (&m)[3], Vec3f v) { m[0].add(v.x), m[1].add(v.y), m[2].add(v.z); }

}  // namespace

TEST_CASE("a distance is where the mean transmittance has fallen to the number", "[media]") {
    Uniform u(1);
    for (const Vec3f sigma : {Vec3f(2.0f), Vec3f{0.1f, 1.0f, 10.0f}, Vec3f{0.0f, 3.0f, 3.0f}, Vec3f{1e-3f, 1e-6f, 5e3f}})
        for (int i = 0; i < 2000; ++i) {
            const MediumRecord m = homogeneous_record(sigma, Vec3f(0.5f));
            PathWeight w;
            if (i % 2 == 1) w.share = {0.3f, 2.2f, 0.5f};
            const float rest = w.mean(Vec3f{sigma.x == 0.0f ? 1.0f : 0.0f, 0.0f, 0.0f});
            const float v = rest + (1.0f - rest) * std::max(u(), 1e-6f);
            const double t = static_cast<double>(distance_to(m, w, v));
            const double back =
                (w.share.x * std::exp(-sigma.x * t) + w.share.y * std::exp(-sigma.y * t) + w.share.z * std::exp(-sigma.z * t)) / 3;
            INFO("sigma " << sigma.x << " " << sigma.y << " " << sigma.z << " v " << v << " t " << t << " back " << back);
            CHECK(std::fabs(back - v) < 3e-6 * v + 2e-7);
        }
}

TEST_CASE("flights through a homogeneous medium carry transmittance and scattering of each channel", "[media]") {
    const Vec3f sigma{0.2f, 1.0f, 3.0f}, albedo{0.9f, 0.5f, 0.7f};
    for (const MediumRecord& m : {homogeneous_record(sigma, albedo), homogeneous_record(Vec3f(0.8f), albedo)}) {
        const Vec3d through = attenuated(to_double(m.sigma_t) * 1.5);
        Mean survived[3], scattered[3], way;
        Uniform u(2);
        double worst = 0;
        for (int i = 0; i < 200000; ++i) {
            PathWeight w;
            w.share = {1.5f, 0.6f, 0.9f};
            w.beta = w.share;  // of a path whose value has the colour of its densities
            WayNumbers numbers;
            numbers.survival = 1.0f - u();
            const Collision c = fly_homogeneous(m, {1, 2, 3}, {0, 0, 1}, 0.5f, 2.0f, w, numbers);
            add(survived, c.happened ? Vec3f(0.0f) : w.beta);
            add(scattered, c.happened ? w.beta : Vec3f(0.0f));
            way.add(c.happened ? 0.0 : 1.0);
            worst = std::max(worst, std::fabs(static_cast<double>(w.mean(Vec3f(1.0f))) - 1));
            if (c.happened)
                CHECK((c.p.z >= 3.5f && c.p.z <= 5.0f && c.p.x == 1.0f));
            else
                CHECK(std::fabs(w.way - (1.5 * through.x + 0.6 * through.y + 0.9 * through.z) / 3) < 1e-5);
        }
        check_near(survived, Vec3d{1.5 * through.x, 0.6 * through.y, 0.9 * through.z});
        check_near(scattered, Vec3d{1.5 * 0.9 * (1 - through.x), 0.6 * 0.5 * (1 - through.y), 0.9 * 0.7 * (1 - through.z)});
        CHECK(worst < 1e-5);
    }
}

TEST_CASE("one number leads through several homogeneous media", "[media]") {
    const MediumRecord a = homogeneous_record({0.2f, 1.0f, 3.0f}, Vec3f(1.0f)), b = homogeneous_record({2.0f, 0.1f, 0.4f}, Vec3f(1.0f));
    Mean through[3];
    Uniform u(4);
    for (int i = 0; i < 200000; ++i) {
        PathWeight w;
        WayNumbers numbers;
        numbers.survival = 1.0f - u();
        const bool out = !fly_homogeneous(a, {}, {0, 0, 1}, 0.0f, 0.5f, w, numbers).happened &&
                         !fly_homogeneous(b, {}, {0, 0, 1}, 0.5f, 1.5f, w, numbers).happened &&
                         !fly_homogeneous(a, {}, {0, 0, 1}, 1.5f, 1.7f, w, numbers).happened;
        add(through, out ? w.beta : Vec3f(0.0f));
    }
    check_near(through, attenuated(to_double(a.sigma_t) * 0.7 + to_double(b.sigma_t) * 1.0));
}

TEST_CASE("tracking through a grid has the means of its integral", "[media]") {
    const Scene scene = coloured_grid();
    const MediumRecord& m = scene.media.at(0);
    const Vec3f o{-1.0f, 0.5f, 0.5f}, d{1, 0, 0};
    const Vec3d through = attenuated(depth(m, 0.0, 3.3));
    Uniform u(7);
    const auto next = [&] { return u(); };
    Mean ratio[3], survived[3], scattered[3], densities[3];
    std::vector<double> bins(33), expected(33);
    for (int i = 0; i < 300000; ++i) {
        const Vec3f t = track_transmittance(m, o, d, 0.0f, 4.3f, next);
        add(ratio, t);
        PathWeight w;
        WayNumbers numbers{1.0f - u(), u(), 0.0f};
        const Collision c = fly_heterogeneous(m, o, d, 0.0f, 4.3f, w, numbers, next);
        add(survived, c.happened ? Vec3f(0.0f) : w.beta);
        add(scattered, c.happened ? w.beta : Vec3f(0.0f));
        add(densities, c.happened ? Vec3f(0.0f) : w.share);
        if (c.happened) bins[static_cast<std::size_t>(std::min(32.0f, c.p.x * 10))] += 1;
    }
    check_near(ratio, through);
    check_near(survived, through);
    check_near(densities, through);  // a channel's share of the paths that come through is its transmittance
    check_near(scattered, Vec3d{0.9 * (1 - through.x), 0.5 * (1 - through.y), 0.2 * (1 - through.z)});
    // Where they scatter: the mean over the channels of sigma_t exp(-depth).
    for (int i = 0; i < 33; ++i) {
        const Vec3d a = attenuated(depth(m, 0.0, 0.1 * i)), b = attenuated(depth(m, 0.0, 0.1 * i + 0.1));
        expected[static_cast<std::size_t>(i)] = 300000 * ((a.x - b.x) + (a.y - b.y) + (a.z - b.z)) / 3;
    }
    CHECK(chi_squared_z(bins, expected) < 5);
}

TEST_CASE("a ray that misses the box of a grid meets nothing", "[media]") {
    const Scene scene = coloured_grid();
    const MediumRecord& m = scene.media.at(0);
    Uniform u(9);
    const auto next = [&] { return u(); };
    for (const auto& [o, d] :
         {std::pair{Vec3f{-1, 2, 0.5f}, Vec3f{1, 0, 0}}, {Vec3f{5, 0.5f, 0.5f}, Vec3f{1, 0, 0}}, {Vec3f{2, -3, 1.5f}, Vec3f{0, 1, 0}}}) {
        CHECK(track_transmittance(m, o, d, 0.0f, kInfinity, next) == Vec3f(1.0f));
        PathWeight w;
        WayNumbers numbers{0.3f, 0.2f, 0.0f};
        CHECK_FALSE(fly_heterogeneous(m, o, d, 0.0f, kInfinity, w, numbers, next).happened);
        CHECK(numbers.survival == 0.3f);
    }
    CHECK(u.counter == 0);
}
