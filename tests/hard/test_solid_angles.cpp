// Densities of light sampling against solid angles. Lights are sampled by area, so no solid angle is ever computed: the mean of 1 / density
// over a light's points is its solid angle, down to sizes where sums of angles have no digit left.

#include <koksma/scene/light_sampling.h>

#include <scenes/render_scene.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// Source: van Oosterom and Strackee 1983, "The solid angle of a plane triangle", equation 8, with the determinant of differences
double solid_angle(Vec3d a, Vec3d b, Vec3d c) {
    const double la = length(a), lb = length(b), lc = length(c);
    const double determinant = std::fabs(dot(a, cross(b - a, c - a)));
    return 2.0 * std::atan2(determinant, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

/// Relative error of the mean of 1 / density over the whole light, as seen from the origin; green lattice of n points.
double error_of(const Scene& scene, double exact) {
    constexpr std::uint32_t kPoints = 1 << 16;
    double sum = 0;
    std::uint32_t y = 0;
    for (std::uint32_t i = 0; i < kPoints; ++i, y += 40503) {
        // A rank-1 lattice, folded (x -> 1 - |2 x - 1|), which converges by n^-2 on smooth integrands.
        const auto fold = [](double x) { return 1.0 - std::fabs(2.0 * x - 1.0); };
        const Vec2f u{std::min(static_cast<float>(fold((i + 0.5) / kPoints)), kOneMinusUlp),
                      std::min(static_cast<float>(fold(((y % kPoints) + 0.5) / kPoints)), kOneMinusUlp)};
        const LightSample s = sample_light<EffectSet::all()>(scene, scene.lights[0], Vec3f{0.0f}, u);
        if (s.pdf_w > 0.0f) sum += 1.0 / double{s.pdf_w};
    }
    return sum / kPoints / exact - 1.0;
}

/// Random numbers in [-1, 1).
struct Numbers {
    std::uint32_t count = 0;
    double operator()() { return 2.0 * unit_float(keyed_hash({15, 16}, count++)) - 1.0; }
    glm::vec3 vector() { return {static_cast<float>((*this)()), static_cast<float>((*this)()), static_cast<float>((*this)())}; }
};

}  // namespace

TEST_CASE("D15: the density of a triangle light is that of its solid angle at every size", "[hard]") {
    Numbers random;
    for (const float size : {1.0f, 0.1f, 1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f}) {
        double worst = 0;
        for (int k = 0; k < 12; ++k) {
            // Differences of corners are exact where the centre has few bits.
            const glm::vec3 n = glm::normalize(random.vector()), centre = 2.0f * glm::round(n * 256.0f) / 256.0f;
            const glm::vec3 a = size * random.vector(), b = size * random.vector(), c = size * random.vector();
            glm::vec3 corners[] = {centre + a, centre + b, centre + c};
            const glm::vec3 ng = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
            if (glm::length(ng) < 0.05f * size * size || std::fabs(glm::dot(glm::normalize(ng), n)) < 0.2f)
                continue;                                                   // needles and edges-on, for which the lattice is too coarse
            if (glm::dot(ng, n) > 0.0f) std::swap(corners[1], corners[2]);  // shines towards the origin
            SceneDescription d = empty_scene();
            add_light(d, mesh({corners[0], corners[1], corners[2]}, {{0, 1, 2}}), Matrix(1.0), Rgb(1.0f));
            const auto exact = [](glm::vec3 v) { return Vec3d{v.x, v.y, v.z}; };
            const double error = error_of(compile(d), solid_angle(exact(corners[0]), exact(corners[1]), exact(corners[2])));
            worst = std::max(worst, std::fabs(error));
        }
        INFO("size " << size << " worst error " << worst);
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("D16: the density of a rectangle light is that of its solid angle at every size", "[hard]") {
    Numbers random;
    for (const double side : {1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        double worst = 0;
        for (int k = 0; k < 12; ++k) {
            const double x = std::round(256 * random()) / 256, y = std::round(256 * random()) / 256;
            SceneDescription d = empty_scene();
            add_light(d, RectangleShape{}, translated({x, y, 1}) * rotated({1, 0, 0}, 180) * scaled(0.5 * side), Rgb(1.0f));
            // Of the true corners: a light's area is computed before its corners are rounded to float.
            const auto corner = [&](double s, double t) { return Vec3d{x + 0.5 * s * side, y + 0.5 * t * side, 1.0}; };
            const double exact =
                solid_angle(corner(-1, -1), corner(1, -1), corner(1, 1)) + solid_angle(corner(-1, -1), corner(1, 1), corner(-1, 1));
            worst = std::max(worst, std::fabs(error_of(compile(d), exact)));
        }
        INFO("side " << side << " worst error " << worst);
        CHECK(worst < 1e-6);
    }
}
