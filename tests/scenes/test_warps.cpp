// Maps from the square keep areas, and their corners are numbers. Points leave surfaces to the right side.

#include "chi_squared.h"
#include "uniform.h"

#include <koksma/sampling/warps.h>
#include <koksma/scene/ray_offset.h>
#include <koksma/scene/distribution.h>
#include <koksma/scene/ray.h>

#include <koksma_catch.h>

#include <functional>
#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr int kBins = 24, kDraws = 300000;
constexpr float kEdges[] = {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.5f + 0x1p-24f, 0.75f, kOneMinusUlp};

double turns(double y, double x) {
    const double t = std::atan2(y, x) / (2.0 * std::numbers::pi);
    return t < 0 ? t + 1.0 : t;
}

/// `to_square` undoes a warp up to its uniform coordinates: its values must be uniform on the square.
double z_of(const std::function<glm::dvec2(Vec2f)>& to_square) {
    std::vector<double> counts(kBins * kBins), expected(counts.size(), double{kDraws} / (kBins * kBins));
    Uniform u(1);
    for (int i = 0; i < kDraws; ++i) {
        const glm::dvec2 q = to_square(u.pair());
        const auto bin = [](double x) { return std::min(kBins - 1, std::max(0, static_cast<int>(x * kBins))); };
        counts[bin(q.x) * kBins + bin(q.y)] += 1;
    }
    return chi_squared_z(counts, expected);
}

}  // namespace

TEST_CASE("warps keep areas", "[scenes]") {
    CHECK(z_of([](Vec2f u) {
              const Vec2f d = square_to_disk(u);
              return glm::dvec2(d.x * d.x + d.y * d.y, turns(d.y, d.x));
          }) < 5.0);
    CHECK(z_of([](Vec2f u) {
              const Vec3f w = square_to_cosine_hemisphere(u);
              return glm::dvec2(w.z * w.z, turns(w.y, w.x));
          }) < 5.0);
    CHECK(z_of([](Vec2f u) {
              const Vec3f w = square_to_sphere(u);
              return glm::dvec2(0.5 * (w.z + 1.0), turns(w.y, w.x));
          }) < 5.0);
    CHECK(z_of([](Vec2f u) {
              const Vec2f b = square_to_triangle(u);
              // Uniform on the triangle: 1 - b1 is the root of a uniform number, b2 uniform in what is left.
              return glm::dvec2((1.0 - b.x) * (1.0 - b.x), b.y / (1.0 - b.x));
          }) < 5.0);
    for (const float h : {2.0f, 0.5f, 1e-2f, 1e-6f, 1e-12f})
        CHECK(z_of([h](Vec2f u) {
                  const Vec3f w = square_to_cone(u, h);
                  // 1 - cos from the sine, which keeps its digits.
                  const double s2 = double{w.x} * w.x + double{w.y} * w.y, one_minus = w.z > 0 ? s2 / (1.0 + std::sqrt(std::max(0.0, 1.0 - s2))) : 1.0 - w.z;
                  return glm::dvec2(one_minus / h, turns(w.y, w.x));
              }) < 5.0);
}

TEST_CASE("warps of edges and corners are numbers in the domain", "[scenes]") {
    for (const float x : kEdges)
        for (const float y : kEdges) {
            const Vec2f u{x, y};
            const Vec2f d = square_to_disk(u);
            INFO("u " << x << " " << y);
            CHECK(d.x * d.x + d.y * d.y <= 1.0f + 3e-7f);
            const Vec3f h = square_to_cosine_hemisphere(u);
            CHECK(h.z >= 0.0f);
            CHECK(std::fabs(length(h) - 1.0f) < 3e-7f);
            CHECK(std::fabs(length(square_to_sphere(u)) - 1.0f) < 3e-7f);
            const Vec2f b = square_to_triangle(u);
            CHECK(b.x >= 0.0f);
            CHECK(b.y >= 0.0f);
            CHECK(b.x + b.y <= 1.0f);
            for (const float cone : {2.0f, 0.5f, 1e-6f, 1e-12f}) {
                const Vec3f w = square_to_cone(u, cone);
                CHECK(std::fabs(length(w) - 1.0f) < 3e-7f);
                CHECK(w.z >= 1.0f - cone - 1e-7f);
            }
        }
}

TEST_CASE("neighbours in the square are neighbours on the disk", "[scenes]") {
    double worst = 0;
    for (int i = 0; i < 999; ++i)
        for (int j = 0; j < 999; ++j) {
            const Vec2f u{static_cast<float>(i) / 1000.0f, static_cast<float>(j) / 1000.0f};
            const Vec2f a = square_to_disk(u), b = square_to_disk<float>({u.x + 0.001f, u.y}), c = square_to_disk<float>({u.x, u.y + 0.001f});
            worst = std::max({worst, std::hypot(double{a.x} - b.x, double{a.y} - b.y), std::hypot(double{a.x} - c.x, double{a.y} - c.y)});
        }
    // Along an edge of the square an eighth of the circle takes 1/2: pi per unit; across, 2; together below 3.8.
    CHECK(worst < 0.0038);
}

TEST_CASE("a discrete distribution draws its weights and gives back uniform numbers", "[scenes]") {
    const double weights[] = {1.0, 0.0, 3.0, 0.5, 0.0, 0.0, 7.5, 1e-3};
    const DiscreteDistribution d(weights);
    std::vector<double> counts(8), expected(8), rest(32), flat(32, 1e6 / 32);
    Uniform u(2);
    for (int i = 0; i < 1000000; ++i) {
        const DiscreteSample s = d.sample(u());
        counts[s.index] += 1;
        rest[static_cast<std::size_t>(s.u * 32.0f)] += 1;
        if (i < 1000) CHECK(s.probability == Approx(d.probability(s.index)));
    }
    double total = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
        expected[i] = 1e6 * weights[i] / 12.001;
        total += d.probability(i);
    }
    CHECK(total == Approx(1.0));
    CHECK(counts[1] + counts[4] + counts[5] == 0.0);
    CHECK(chi_squared_z(counts, expected) < 5.0);
    CHECK(chi_squared_z(rest, flat) < 5.0);
}

TEST_CASE("a point leaves its surface to the side of the direction and beyond its error", "[scenes]") {
    Uniform u(3);
    for (int i = 0; i < 20000; ++i) {
        const Vec3f n = square_to_sphere(u.pair()), w = square_to_sphere(u.pair());
        const float scale = std::exp2(80.0f * u() - 40.0f);
        const Vec3f p = square_to_sphere(u.pair()) * scale, error = abs(p) * error_gamma(7);
        const Vec3f q = offset_origin(p, error, n, w);
        const Vec3d moved = to_double(q) - to_double(p);
        const double side = dot(w, n) < 0.0f ? -1.0 : 1.0;
        const double along = side * dot(moved, to_double(n));
        const double bound = std::fabs(double{n.x}) * error.x + std::fabs(double{n.y}) * error.y + std::fabs(double{n.z}) * error.z;
        REQUIRE(along >= bound * (1.0 - 1e-6));
        // And not much further: the bound and two roundings of each coordinate.
        REQUIRE(length(moved) <= bound * 1.001 + 3.0 * 1.2e-7 * scale);
    }
}
