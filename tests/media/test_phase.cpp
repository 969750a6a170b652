// Phase functions: they integrate to one, have the mean cosine that they promise, and are sampled with the density that they say.

#include <koksma/scene/medium/phase.h>

#include <koksma_catch.h>
#include <scenes/chi_squared.h>
#include <scenes/uniform.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace koksma;
using namespace koksma::testing;

namespace {
constexpr float kAsymmetries[] = {-0.95f, -0.7f, -0.2f, -1e-3f, 0.0f, 1e-5f, 0.1f, 0.5f, 0.8f, 0.95f, 0.995f};
}

TEST_CASE("phase functions integrate to one and have g as mean cosine", "[media]") {
    for (const float g : kAsymmetries) {
        // In x = the cosine of the deflection, by the midpoint rule where the substitution 1 - |g| x = e^t makes the peak wide.
        const double a = std::fabs(static_cast<double>(g));
        double integral = 0, mean = 0;
        constexpr int kSteps = 200000;
        for (int i = 0; i < kSteps; ++i) {
            double c, dc;
            if (a < 1e-2) {
                c = -1 + 2 * (i + 0.5) / kSteps, dc = 2.0 / kSteps;
            } else {
                const double t0 = std::log(1 + a), t1 = std::log(1 - a), t = t0 + (t1 - t0) * (i + 0.5) / kSteps;
                c = (1 - std::exp(t)) / a, dc = -std::exp(t) / a * (t1 - t0) / kSteps;
            }
            const double deflection = g >= 0 ? c : -c;
            const double p = eval_phase(g, static_cast<float>(-deflection)) * 2 * std::numbers::pi * dc;
            integral += p, mean += p * deflection;
        }
        INFO("g " << g << " integral " << integral << " mean cosine " << mean);
        CHECK(std::fabs(integral - 1) < 2e-5 / (1 - a));
        CHECK(std::fabs(mean - g) < 2e-5 / (1 - a));
    }
}

TEST_CASE("phase functions are sampled with their density", "[media]") {
    constexpr int kCosines = 24, kAngles = 8, kSamples = 1 << 18;
    for (const float g : kAsymmetries)
        for (const Vec3f wo : {Vec3f{0, 0, 1}, Vec3f{0.6f, 0, -0.8f}, Vec3f{0, -1, 0}}) {
            // Bins of equal probability in the cosine, by the closed form of its distribution, and of equal angle about the axis.
            const double a = g;
            const auto cosine_at = [&](double u) {
                if (std::fabs(a) < 1e-4) return 2 * u - 1;
                const double q = (1 - a * a) / (1 - a + 2 * a * u);
                return (1 + a * a - q * q) / (2 * a);
            };
            std::vector<double> edges;
            for (int i = 1; i < kCosines; ++i) edges.push_back(cosine_at(static_cast<double>(i) / kCosines));
            const Frame frame = Frame::from_normal(-wo);
            std::vector<double> counts(kCosines * kAngles),
                expected(kCosines * kAngles, static_cast<double>(kSamples) / (kCosines * kAngles));
            Uniform u(11);
            double worst = 0;
            for (int i = 0; i < kSamples; ++i) {
                const Vec3f wi = sample_phase(g, wo, u.pair());
                worst = std::max(worst, std::fabs(static_cast<double>(length(wi)) - 1));
                const Vec3f local = frame.to_local(wi);
                const auto bin =
                    static_cast<int>(std::upper_bound(edges.begin(), edges.end(), static_cast<double>(local.z)) - edges.begin());
                const double phi = std::atan2(local.y, local.x) / (2 * std::numbers::pi) + 0.5;
                counts[static_cast<std::size_t>(bin * kAngles + std::min(kAngles - 1, static_cast<int>(phi * kAngles)))] += 1;
            }
            INFO("g " << g << " wo " << wo.x << " " << wo.y << " " << wo.z);
            CHECK(chi_squared_z(counts, expected) < 5);
            CHECK(worst < 1e-5);
        }
}

TEST_CASE("phase functions are reciprocal and stay finite at their peaks", "[media]") {
    Uniform u(3);
    for (const float g : kAsymmetries)
        for (int i = 0; i < 1000; ++i) {
            const Vec3f a = square_to_sphere(u.pair()), b = square_to_sphere(u.pair());
            CHECK(eval_phase(g, dot(a, b)) == eval_phase(g, dot(b, a)));
            const float ahead = eval_phase(g, -1.0f), behind = eval_phase(g, 1.0f);
            const double peak = (1.0 + std::fabs(static_cast<double>(g))) /
                                ((1 - std::fabs(static_cast<double>(g))) * (1 - std::fabs(static_cast<double>(g)))) /
                                (4 * std::numbers::pi);
            CHECK(std::fabs((g > 0 ? ahead : behind) / peak - 1) < 1e-3);
        }
}
