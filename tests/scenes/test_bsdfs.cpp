// BSDFs against their own promises: density, weight, reciprocity, energy, closed forms.

#include "chi_squared.h"
#include "render_scene.h"
#include "uniform.h"

#include <complex>
#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr EffectSet kAll = EffectSet::all();
constexpr double kPiDouble = std::numbers::pi;

Bsdf diffuse(float albedo) {
    Bsdf b;
    b.kind = BsdfKind::diffuse;
    b.reflectance = Vec3f(albedo);
    return b;
}
Bsdf rough(float u, float v, bool ggx) {
    Bsdf b;
    b.kind = BsdfKind::rough_conductor;
    b.perfect = true;
    b.reflectance = Vec3f(1.0f);
    b.facets = {u, v, ggx};
    return b;
}
Bsdf glass(float eta) {
    Bsdf b;
    b.kind = BsdfKind::dielectric;
    b.reflectance = b.transmittance = Vec3f(1.0f);
    b.eta = Vec3f(eta);
    return b;
}

Vec3f direction(double degrees, double azimuth) {
    const double t = glm::radians(degrees), p = glm::radians(azimuth);
    return {static_cast<float>(std::sin(t) * std::cos(p)), static_cast<float>(std::sin(t) * std::sin(p)), static_cast<float>(std::cos(t))};
}

struct Case {
    std::string name;
    Bsdf bsdf;
};
std::vector<Case> smooth_cases() {
    std::vector<Case> out{{"diffuse", diffuse(0.8f)}};
    for (const bool ggx : {true, false}) {
        const std::string name = ggx ? "ggx " : "beckmann ";
        for (const float a : {1.0f, 0.5f, 0.3f, 0.15f}) out.push_back({name + std::to_string(a), rough(a, a, ggx)});
        out.push_back({name + "0.6 x 0.2", rough(0.6f, 0.2f, ggx)});
    }
    return out;
}

/// Fresnel reflectance of a conductor in double, by complex arithmetic.
double exact_conductor(double cos_i, double eta, double k) {
    using C = std::complex<double>;
    const C n(eta, k), ct = std::sqrt(C(1.0) - (1.0 - cos_i * cos_i) / (n * n));
    const C rs = (cos_i - n * ct) / (cos_i + n * ct), rp = (n * cos_i - ct) / (n * cos_i + ct);
    return 0.5 * (std::norm(rs) + std::norm(rp));
}

}  // namespace

TEST_CASE("samples of smooth BSDFs follow their density, whose integral is 1 at most", "[scenes]") {
    constexpr int kZ = 24, kPhi = 48, kSub = 16, kDraws = 200000;
    for (const Case& c : smooth_cases())
        for (const double degrees : {0.0, 40.0, 75.0, 88.0}) {
            const Vec3f wo = direction(degrees, 25);
            std::vector<double> counts(kZ * kPhi), expected(counts.size());
            double integral = 0;
            for (int z = 0; z < kZ; ++z)
                for (int p = 0; p < kPhi; ++p) {
                    double sum = 0;
                    for (int i = 0; i < kSub; ++i)
                        for (int j = 0; j < kSub; ++j) {
                            const double cz = (z + (i + 0.5) / kSub) / kZ, phi = 2.0 * kPiDouble * (p + (j + 0.5) / kSub) / kPhi, s = std::sqrt(1.0 - cz * cz);
                            const Vec3f wi{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(cz)};
                            sum += eval_bsdf<kAll>(c.bsdf, wo, wi).pdf_w;
                        }
                    const double mass = sum * 2.0 * kPiDouble / (kZ * kPhi * kSub * kSub);
                    expected[z * kPhi + p] = mass * kDraws;
                    integral += mass;
                }
            Uniform u(static_cast<std::uint32_t>(degrees) + 1000);
            double accepted = 0;
            for (int i = 0; i < kDraws; ++i) {
                const BsdfSample s = sample_bsdf<kAll>(c.bsdf, wo, 0.0f, u.pair());
                if (!(s.pdf_w > 0.0f)) continue;
                accepted += 1.0 / kDraws;
                const int z = std::min(kZ - 1, static_cast<int>(s.wi.z * kZ));
                double turns = std::atan2(s.wi.y, s.wi.x) / (2.0 * kPiDouble);
                if (turns < 0) turns += 1.0;
                counts[z * kPhi + std::min(kPhi - 1, static_cast<int>(turns * kPhi))] += 1;
            }
            const double z = chi_squared_z(counts, expected);
            INFO(c.name << " from " << degrees << " degrees: integral " << integral << ", accepted " << accepted << ", chi-squared z " << z);
            CHECK(integral <= 1.0 + 2e-3);  // midpoint rule
            // Binomial noise of 200000 draws, 1.1e-3 at most, times 5; the midpoint rule.
            CHECK(std::fabs(accepted - integral) <= 5.0 * std::sqrt(integral * std::fabs(1.0 - integral) / kDraws) + 2e-3);
            CHECK(z < 5.0);
        }
}

TEST_CASE("the weight of a sample is f cos / pdf, and its density that of evaluation", "[scenes]") {
    std::vector<Case> all = smooth_cases();
    for (const bool ggx : {true, false})
        for (const float a : {0.03f, 0.01f, 1e-3f, 1e-4f}) all.push_back({(ggx ? "ggx " : "beckmann ") + std::to_string(a), rough(a, a, ggx)});
    for (const Case& c : all)
        for (const double degrees : {0.0, 40.0, 75.0, 88.0}) {
            const Vec3f wo = direction(degrees, 200);
            Uniform u(3);
            double worst_weight = 0, worst_pdf = 0;
            for (int i = 0; i < 4000; ++i) {
                const BsdfSample s = sample_bsdf<kAll>(c.bsdf, wo, 0.0f, u.pair());
                if (!(s.pdf_w > 0.0f)) continue;
                REQUIRE(std::fabs(length(s.wi) - 1.0f) < 1e-5f);
                const BsdfValue v = eval_bsdf<kAll>(c.bsdf, wo, s.wi);
                worst_weight = std::max(worst_weight, std::fabs(double{v.f_cos.y} / v.pdf_w / s.weight.y - 1.0));
                worst_pdf = std::max(worst_pdf, std::fabs(double{v.pdf_w} / s.pdf_w - 1.0));
            }
            INFO(c.name << " from " << degrees << " degrees: weight off by " << worst_weight << ", density by " << worst_pdf);
            // Evaluation makes the half vector anew from directions in float: 6e-8 / alpha of a slope, more where slopes are large;
            // and 6e-8 over the square of the cosine, 5e-5 at 88 degrees.
            const double alpha = c.bsdf.kind == BsdfKind::diffuse ? 1.0 : std::min(c.bsdf.facets.alpha_u, c.bsdf.facets.alpha_v);
            CHECK(worst_weight <= 1e-4 + 2e-6 / alpha);
            CHECK(worst_pdf <= 1e-4 + 1e-5 / alpha);
        }
}

TEST_CASE("reflection is reciprocal", "[scenes]") {
    for (const Case& c : smooth_cases()) {
        Uniform u(11);
        double worst = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3f a = square_to_cosine_hemisphere(u.pair()), b = square_to_cosine_hemisphere(u.pair());
            if (a.z < 0.01f || b.z < 0.01f) continue;
            const double ab = double{eval_bsdf<kAll>(c.bsdf, a, b).f_cos.y} / b.z, ba = double{eval_bsdf<kAll>(c.bsdf, b, a).f_cos.y} / a.z;
            if (ab > 1e-30) worst = std::max(worst, std::fabs(ab / ba - 1.0));
        }
        INFO(c.name << " worst " << worst);
        CHECK(worst < 1e-5);
    }
}

TEST_CASE("no surface reflects more than arrives", "[scenes]") {
    for (const bool ggx : {true, false})
        for (const float alpha : {1.0f, 0.5f, 0.1f, 0.01f, 1e-3f, 1e-4f})
            for (const double degrees : {0.0, 30.0, 60.0, 85.0, 89.0}) {
                const Bsdf b = rough(alpha, alpha, ggx);
                Uniform u(5);
                double sum = 0, squares = 0;
                constexpr int kDraws = 20000;
                for (int i = 0; i < kDraws; ++i) {
                    const double w = sample_bsdf<kAll>(b, direction(degrees, 0), 0.0f, u.pair()).weight.y;
                    sum += w;
                    squares += w * w;
                }
                const double mean = sum / kDraws, error = std::sqrt(std::max(0.0, squares / kDraws - mean * mean) / kDraws);
                INFO((ggx ? "ggx " : "beckmann ") << alpha << " from " << degrees << " degrees: albedo " << mean << " +- " << error);
                // The rational fit of Beckmann's masking is off by 0.35 % at most (Walter et al. 2007).
                CHECK(mean <= 1.0 + 5.0 * error + (ggx ? 1e-5 : 3.5e-3));
                CHECK(mean > 0.2);
            }
}

TEST_CASE("GGX has the single-scattering albedo of uncorrelated masking", "[scenes]") {
    struct Row {
        float alpha;
        double at_0, at_60, at_85;
    };
    for (const Row& row : {Row{0.01f, 1.0, 0.99979, 0.99222}, Row{0.1f, 0.98831, 0.96911, 0.87313}, Row{0.3f, 0.87736, 0.81813, 0.84700},
                           Row{0.5f, 0.68785, 0.68601, 0.77720}, Row{0.7f, 0.50372, 0.56581, 0.69215}, Row{1.0f, 0.30685, 0.40914, 0.56451}})
        for (const auto& [degrees, expected] : {std::pair{0.0, row.at_0}, {60.0, row.at_60}, {85.0, row.at_85}}) {
            // A jittered grid of 512 x 512: its error is below 1e-4.
            Uniform u(9);
            double sum = 0;
            for (int i = 0; i < 512; ++i)
                for (int j = 0; j < 512; ++j) {
                    const Vec2f v{(static_cast<float>(i) + u()) / 512.0f, (static_cast<float>(j) + u()) / 512.0f};
                    sum += sample_bsdf<kAll>(rough(row.alpha, row.alpha, true), direction(degrees, 0), 0.0f,
                                             {std::min(v.x, kOneMinusUlp), std::min(v.y, kOneMinusUlp)})
                               .weight.y;
                }
            INFO("alpha " << row.alpha << " from " << degrees << " degrees: " << sum / (512 * 512) << " expected " << expected);
            CHECK(std::fabs(sum / (512 * 512) - expected) < 3e-4);
        }
}

TEST_CASE("glass obeys Snell and Fresnel", "[scenes]") {
    for (const float eta : {1.0001f, 1.33f, 1.5f, 2.4f, 0.6666667f})
        for (const double degrees : {0.001, 10.0, 30.0, 41.0, 60.0, 80.0, 89.9})
            for (const bool inside : {false, true}) {
                Vec3f wo = direction(degrees, 70);
                if (inside) wo.z = -wo.z;
                const double n = inside ? 1.0 / double{eta} : double{eta};  // transmitted over incident
                const double ci = std::fabs(double{wo.z}), st2 = (1.0 - ci * ci) / (n * n);
                double f = 1.0;
                if (st2 < 1.0) {
                    const double ct = std::sqrt(1.0 - st2), rs = (ci - n * ct) / (ci + n * ct), rp = (n * ci - ct) / (n * ci + ct);
                    f = 0.5 * (rs * rs + rp * rp);
                }
                INFO("eta " << eta << " angle " << degrees << (inside ? " inside" : " outside") << " F " << f);
                CHECK(fresnel_dielectric(wo.z, eta).reflectance == Approx(f).epsilon(2e-4).margin(2e-7));
                const BsdfSample reflected = sample_bsdf<kAll>(glass(eta), wo, 0.0f, {0, 0});
                if (reflected.wi.z * wo.z > 0.0f) {
                    CHECK(reflected.wi == Vec3f{-wo.x, -wo.y, wo.z});
                    CHECK(reflected.weight.x == 1.0f);
                }
                const BsdfSample refracted = sample_bsdf<kAll>(glass(eta), wo, kOneMinusUlp, {0, 0});
                CHECK((refracted.wi.z * wo.z < 0.0f) == (st2 < 1.0 && f < 1.0 - 1e-7));
                if (refracted.wi.z * wo.z < 0.0f) {
                    CHECK(std::fabs(double{refracted.wi.x} * n + wo.x) < 1e-6);
                    CHECK(std::fabs(double{refracted.wi.y} * n + wo.y) < 1e-6);
                    CHECK(refracted.weight.x == Approx(1.0 / (n * n)).epsilon(1e-6));
                    CHECK(refracted.eta == Approx(n).epsilon(1e-6));
                    CHECK(refracted.pdf_w == Approx(1.0 - f).epsilon(1e-4).margin(1e-6));
                }
            }
}

TEST_CASE("metals reflect by the complex Fresnel equations", "[scenes]") {
    double worst = 0;
    for (const double eta : {0.05, 0.2, 0.88, 1.66, 3.0})
        for (const double k : {0.1, 1.0, 4.8, 9.2})
            for (int i = 0; i <= 100; ++i) {
                const auto c = static_cast<float>(std::max(1e-3, i / 100.0));
                worst = std::max(worst, std::fabs(fresnel_conductor(c, static_cast<float>(eta), static_cast<float>(k)) -
                                                  exact_conductor(c, static_cast<float>(eta), static_cast<float>(k))));
            }
    INFO("worst error " << worst);
    CHECK(worst < 1e-5);  // a difference of squares near 1
    for (const float eta : {0.0f, 1e-3f, 0.5f, 0.999f, 1.0f, 1.001f, 1.5f})
        for (const float k : {0.0f, 1e-6f, 1e-4f, 1e-2f, 1.0f})
            for (int i = 1; i <= 1000; ++i) {
                const float r = fresnel_conductor(static_cast<float>(i) / 1000.0f, eta, k);
                REQUIRE(r >= 0.0f);
                REQUIRE(r <= 1.000001f);
            }
    for (const auto& [eta, k] : {std::pair{0.2f, 3.9f}, {1.66f, 9.2f}}) {
        const double normal = ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
        CHECK(fresnel_conductor(1.0f, eta, k) == Approx(normal).epsilon(1e-5));
        CHECK(fresnel_conductor(1e-6f, eta, k) == Approx(1.0).epsilon(1e-4));
    }
}

TEST_CASE("a BSDF gives nothing across its surface", "[scenes]") {
    for (const Case& c : smooth_cases())
        for (const auto& [wo, wi] : {std::pair{direction(30, 0), direction(150, 40)}, {direction(150, 40), direction(30, 0)},
                                     {direction(120, 0), direction(110, 40)}, {direction(90, 0), direction(30, 0)}}) {
            Vec3f o = wo;
            if (std::fabs(o.z) < 1e-6f) o.z = 0.0f;
            const BsdfValue v = eval_bsdf<kAll>(c.bsdf, o, wi);
            CHECK(v.pdf_w == 0.0f);
            CHECK(max_component(v.f_cos) == 0.0f);
            if (!(o.z > 0.0f)) CHECK(sample_bsdf<kAll>(c.bsdf, o, 0.0f, {0.3f, 0.4f}).pdf_w == 0.0f);
        }
}
