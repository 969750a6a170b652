// Layered BSDFs against their own promises and closed forms.

#include "chi_squared.h"
#include "layered_materials.h"
#include "render_scene.h"
#include "uniform.h"

#include <koksma/scene/bsdf/layered_parts.h>

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// A material at a point of a square.
class Sample {
public:
    explicit Sample(const Material& m) : scene_([&] {
        SceneDescription d = empty_scene();
        d.materials.push_back(m);
        add_shape(d, RectangleShape{}, scaled(1), 1);
        return compile(d);
    }()), at_{scene_.materials[1].front, {0.3f, 0.6f}, {0.0f, 0.0f, 1.0f}, 0, 0} {}
    [[nodiscard]] BsdfValue eval(Vec3f wo, Vec3f wi) const { return eval_layered(scene_, at_, wo, wi); }
    [[nodiscard]] BsdfSample sample(Vec3f wo, float u_lobe, Vec2f u) const { return sample_layered(scene_, at_, wo, u_lobe, u); }

private:
    Scene scene_;
    LayeredPoint at_;
};

Vec3f direction(double degrees, double azimuth) {
    const double t = glm::radians(degrees), p = glm::radians(azimuth);
    return {static_cast<float>(std::sin(t) * std::cos(p)), static_cast<float>(std::sin(t) * std::sin(p)), static_cast<float>(std::cos(t))};
}

/// Mean of the samples' weights, green; what refraction compresses put back.
Measured albedo(const Sample& s, Vec3f wo, int draws) {
    Uniform u(77);
    double sum = 0, squares = 0;
    for (int i = 0; i < draws; ++i) {
        const float lobe = u();
        const BsdfSample b = s.sample(wo, lobe, u.pair());
        const double w = b.pdf_w > 0.0f ? double{b.weight.y} * b.eta * b.eta : 0.0;
        sum += w;
        squares += w * w;
    }
    Measured m;
    m.mean = sum / draws;
    m.standard_error = std::sqrt(std::max(0.0, squares / draws - m.mean * m.mean) / draws);
    return m;
}

constexpr double kAngles[] = {0.0, 40.0, 75.0, 100.0, 160.0};

}  // namespace

TEST_CASE("samples of layered BSDFs follow their density, whose integral is 1 at most", "[scenes]") {
    constexpr int kZ = 40, kPhi = 40, kSub = 8, kDraws = 100000;
    for (const Material& m : layered_materials()) {
        const Sample s(m);
        for (const double degrees : kAngles) {
            const Vec3f wo = direction(degrees, 25);
            std::vector<double> counts(kZ * kPhi), expected(counts.size());
            double integral = 0;
            for (int z = 0; z < kZ; ++z)
                for (int p = 0; p < kPhi; ++p) {
                    double sum = 0;
                    for (int i = 0; i < kSub; ++i)
                        for (int j = 0; j < kSub; ++j) {
                            // Even in angle: refracted lobes are narrow.
                            const double theta = std::numbers::pi * (z + (i + 0.5) / kSub) / kZ, phi = kTwoPi * (p + (j + 0.5) / kSub) / kPhi, sz = std::sin(theta);
                            sum += sz * s.eval(wo, {static_cast<float>(sz * std::cos(phi)), static_cast<float>(sz * std::sin(phi)), static_cast<float>(std::cos(theta))}).pdf_w;
                        }
                    const double mass = sum * std::numbers::pi * kTwoPi / (kZ * kPhi * kSub * kSub);
                    expected[z * kPhi + p] = mass * kDraws;
                    integral += mass;
                }
            Uniform u(static_cast<std::uint32_t>(degrees) + 1000);
            double accepted = 0, delta = 0;
            for (int i = 0; i < kDraws; ++i) {
                const float lobe = u();
                const BsdfSample b = s.sample(wo, lobe, u.pair());
                if (!(b.pdf_w > 0.0f)) continue;
                (b.delta ? delta : accepted) += 1.0 / kDraws;
                if (b.delta) continue;
                const int z = std::min(kZ - 1, static_cast<int>(std::acos(std::clamp(double{b.wi.z}, -1.0, 1.0)) / std::numbers::pi * kZ));
                double turns = std::atan2(b.wi.y, b.wi.x) / kTwoPi;
                if (turns < 0) turns += 1.0;
                counts[z * kPhi + std::min(kPhi - 1, static_cast<int>(turns * kPhi))] += 1;
            }
            INFO(m.id << " from " << degrees << " degrees: integral " << integral << ", accepted " << accepted << ", delta " << delta);
            CHECK(integral + delta <= 1.0 + 8e-3);  // midpoint rule and binomial noise
            CHECK(std::fabs(accepted - integral) <= 5.0 * std::sqrt(integral * std::fabs(1.0 - integral) / kDraws) + 4e-3);
            if (accepted > 0.01) {
                const double z = chi_squared_z(counts, expected);
                INFO("chi-squared z " << z);
                CHECK(z < 5.0);
            }
        }
    }
}

TEST_CASE("the weight of a layered sample is f cos / pdf, and its density that of evaluation", "[scenes]") {
    for (const Material& m : layered_materials()) {
        const Sample s(m);
        for (const double degrees : kAngles) {
            const Vec3f wo = direction(degrees, 200);
            Uniform u(3);
            double worst_weight = 0, worst_pdf = 0;
            for (int i = 0; i < 4000; ++i) {
                const float lobe = u();
                const BsdfSample b = s.sample(wo, lobe, u.pair());
                if (!(b.pdf_w > 0.0f)) continue;
                REQUIRE(std::fabs(length(b.wi) - 1.0f) < 1e-5f);
                if (b.delta || std::fabs(b.wi.z) < 0.02f) continue;
                const BsdfValue v = s.eval(wo, b.wi);
                worst_weight = std::max(worst_weight, std::fabs(double{v.f_cos.y} / v.pdf_w - b.weight.y) / std::max(1e-3, double{b.weight.y}));
                worst_pdf = std::max(worst_pdf, std::fabs(double{v.pdf_w} / b.pdf_w - 1.0));
            }
            INFO(m.id << " from " << degrees << " degrees: weight off by " << worst_weight << ", density by " << worst_pdf);
            CHECK(worst_weight <= 2e-3);  // the half vector anew from directions in float
            CHECK(worst_pdf <= 2e-3);
        }
    }
}

TEST_CASE("plastics and rough glass are reciprocal, refraction up to the square of the index", "[scenes]") {
    for (const Material& m : layered_materials()) {
        const auto* glass = std::get_if<RoughDielectric>(&m.front);
        if (glass == nullptr && !std::holds_alternative<Plastic>(m.front) && !std::holds_alternative<RoughPlastic>(m.front)) continue;
        const double eta = glass != nullptr ? double{glass->int_ior} / glass->ext_ior : 1.0;
        const Sample s(m);
        Uniform u(11);
        int tested = 0, off = 0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3f a = square_to_sphere(u.pair()), b = square_to_sphere(u.pair());
            if (std::fabs(a.z) < 0.05f || std::fabs(b.z) < 0.05f) continue;
            // The index on the side of wi is in f(wo, wi) as its inverse square.
            const double ab = double{s.eval(a, b).f_cos.y} / std::fabs(b.z) * (b.z < 0 ? eta * eta : 1.0);
            const double ba = double{s.eval(b, a).f_cos.y} / std::fabs(a.z) * (a.z < 0 ? eta * eta : 1.0);
            if (!(ab > 1e-6)) continue;
            ++tested;
            off += std::fabs(ab / ba - 1.0) > 1e-4;
            CHECK(std::fabs(ab / ba - 1.0) < 3e-2);
        }
        INFO(m.id << ": " << off << " of " << tested << " off by more than 1e-4");
        CHECK(tested > 200);
        CHECK(off * 50 < tested);  // near the critical angle, where Fresnel's reflectance has no slope in float
    }
}

TEST_CASE("no layered surface gives more than arrives", "[scenes]") {
    for (const Material& m : layered_materials()) {
        if (std::holds_alternative<Principled>(m.front)) continue;  // sheen and tints add
        const Sample s(m);
        for (const double degrees : {0.0, 30.0, 60.0, 85.0, 120.0, 175.0}) {
            const Measured a = albedo(s, direction(degrees, 10), 20000);
            INFO(m.id << " from " << degrees << " degrees: albedo " << a.mean << " +- " << a.standard_error);
            CHECK(a.mean <= 1.0 + 5.0 * a.standard_error + 3.5e-3);
        }
    }
}

TEST_CASE("rough glass without roughness loses nothing, down to an index of 1", "[scenes]") {
    for (const Facets distribution : {Facets::ggx, Facets::beckmann})
        for (const float index : {1.5f, 1.0001f, 1.000001f, 1.0000002f, 1.0f, 0.7f})
            for (const double degrees : {0.0, 45.0, 70.0, 110.0, 160.0}) {
                const Sample s(material("", rough_glass(distribution, 1e-4f, 1e-4f, index)));
                const Measured a = albedo(s, direction(degrees, 10), 4000);
                INFO("index " << index << " from " << degrees << " degrees: albedo " << a.mean << " +- " << a.standard_error);
                CHECK(std::fabs(a.mean - 1.0) < 3e-3 + 5 * a.standard_error);
                if (index < 1.00001f && index >= 1.0f) {
                    const BsdfSample b = s.sample(direction(degrees, 10), 0.5f, {0.3f, 0.6f});
                    CHECK(length(b.wi + direction(degrees, 10)) < 1e-4f);
                    CHECK(b.delta == (index == 1.0f));
                }
            }
}

TEST_CASE("rough glass becomes glass", "[scenes]") {
    for (const double degrees : {10.0, 50.0, 80.0, 130.0, 160.0}) {
        const Sample rough(material("", rough_glass(Facets::ggx, 1e-4f, 1e-4f))), smooth(material("", Dielectric{1.5f, 1.0f, Rgb(1.0f), Rgb(1.0f)}));
        const Vec3f wo = direction(degrees, 10);
        for (const float lobe : {0.0f, 0.01f, 0.2f, 0.9999f}) {
            const BsdfSample a = rough.sample(wo, lobe, {0.4f, 0.2f}), b = smooth.sample(wo, lobe, {0, 0});
            INFO(degrees << " degrees, lobe " << lobe);
            CHECK(length(a.wi - b.wi) < 2e-3f);
            CHECK(a.eta == Approx(b.eta));
            CHECK(a.weight.y == Approx(b.weight.y).epsilon(1e-3));
        }
    }
}

TEST_CASE("rough plastic becomes plastic", "[scenes]") {
    RoughPlastic rough = rough_plastic(Facets::ggx, 1e-3f);
    Plastic smooth;
    smooth.diffuse_reflectance = rough.diffuse_reflectance;
    const Sample a(material("", rough)), b(material("", smooth));
    for (const double from : {5.0, 40.0, 60.0})
        for (const double to : {20.0, 50.0, 70.0}) {
            const BsdfValue x = a.eval(direction(from, 0), direction(to, 90)), y = b.eval(direction(from, 0), direction(to, 90));
            INFO(from << " to " << to);
            // The rough one's inner reflectance is Mitsuba's mean of 64 nodes, 1.6 % below the integral; 1 minus it divides the base.
            CHECK(x.f_cos.y == Approx(y.f_cos.y).epsilon(4e-2));
        }
}

TEST_CASE("a thin pane reflects what all its inner reflections add up to", "[scenes]") {
    const Sample pane(material("", ThinDielectric{1.5f, 1.0f, Rgb(1.0f), Rgb(1.0f)}));
    for (const double degrees : {0.0, 30.0, 60.0, 85.0, 120.0, 180.0}) {
        const Vec3f wo = direction(degrees, 30);
        const double once = fresnel_dielectric(std::fabs(wo.z), 1.5f).reflectance;
        double r = once, through = (1 - once) * (1 - once);
        for (int i = 0; i < 200; ++i) r += through * std::pow(once, 2 * i + 1);
        const BsdfSample a = pane.sample(wo, 0.0f, {0, 0}), b = pane.sample(wo, kOneMinusUlp, {0, 0});
        CHECK(a.pdf_w == Approx(r).epsilon(1e-5));
        CHECK(a.wi == Vec3f{-wo.x, -wo.y, wo.z});
        CHECK(b.wi == -wo);
        CHECK(b.pdf_w == Approx(1 - r).epsilon(1e-5));
        CHECK(b.eta == 1.0f);
    }
}

TEST_CASE("blends and masks are their parts at both ends", "[scenes]") {
    const Material diffuse = material("", Diffuse{Rgb(0.2f, 0.5f, 0.8f)}), coat = material("", rough_plastic(Facets::ggx, 0.3f));
    const Sample first(diffuse), second(coat), at_0(material("", Blend{Rgb(0.0f), {diffuse, coat}})), at_1(material("", Blend{Rgb(1.0f), {diffuse, coat}}));
    const Sample quarter(material("", Blend{Rgb(0.25f), {diffuse, coat}})), opaque(material("", Mask{Rgb(1.0f), {coat}})), open(material("", Mask{Rgb(0.0f), {coat}}));
    const Vec3f wo = direction(30, 0), wi = direction(50, 100);
    const auto same = [](const BsdfValue& a, const BsdfValue& b) { return a.f_cos == b.f_cos && a.pdf_w == b.pdf_w; };
    CHECK(same(at_0.eval(wo, wi), first.eval(wo, wi)));
    CHECK(same(at_1.eval(wo, wi), second.eval(wo, wi)));
    CHECK(quarter.eval(wo, wi).f_cos.y == Approx(0.75f * first.eval(wo, wi).f_cos.y + 0.25f * second.eval(wo, wi).f_cos.y));
    CHECK(same(opaque.eval(wo, wi), second.eval(wo, wi)));
    CHECK(open.eval(wo, wi).pdf_w == 0.0f);
    const Sample null(material("", Null{}));
    for (const Sample* s : {&open, &null}) {
        const BsdfSample b = s->sample(wo, 0.7f, {0.1f, 0.2f});
        CHECK((b.wi == -wo && b.weight == Vec3f(1.0f) && b.pdf_w == 1.0f && b.delta && b.eta == 1.0f));
    }
}

TEST_CASE("a flat normal map changes nothing, and a tilted one tilts", "[scenes]") {
    const Material coat = material("", rough_plastic(Facets::ggx, 0.3f));
    const Sample plain(coat), flat(material("", NormalMap{Rgb(0.5f, 0.5f, 1.0f), {true, true, {coat}}}));
    const Vec3f wo = direction(30, 0), wi = direction(50, 100);
    CHECK(flat.eval(wo, wi).f_cos.y == Approx(plain.eval(wo, wi).f_cos.y));
    const Material diffuse = material("", Diffuse{Rgb(0.5f)});
    const Vec3f n = direction(20, 60);
    const Sample tilted(material("", NormalMap{Rgb(0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z), {false, false, {diffuse}}}));
    CHECK(tilted.eval(wo, wi).f_cos.y == Approx(0.5f * kInvPi * dot(n, wi)));
    // A ramp of one unit of height over one of u, on a square of side 2: dz/dx = 1/2.
    BitmapTexture ramp;
    ramp.image = image(2, 1, {Rgb(0.25f), Rgb(0.75f)});
    ramp.wrap = BitmapTexture::Wrap::clamp;
    const Sample bumped(material("", BumpMap{ramp, 1.0f, {false, false, {diffuse}}}));
    CHECK(bumped.eval(wo, wi).f_cos.y == Approx(0.5f * kInvPi * dot(normalize(Vec3f{-0.5f, 0.0f, 1.0f}), wi)).epsilon(1e-5));
}

TEST_CASE("a transmission mask lets a lamp shine through, in proportion", "[scenes]") {
    for (const float opacity : {0.0f, 0.3f, 1.0f}) {
        SceneDescription d = empty_scene();
        d.materials.push_back(material("", Mask{Rgb(opacity), {material("", Diffuse{Rgb(0.0f)})}}));
        d.environment = ConstantEnvironment{Rgb(0.8f), {}};
        add_shape(d, SphereShape{}, scaled(1), 1);
        look_narrowly(d, {0, 0, 3}, {0, 0, 0});
        const Measured m = measure(Ready(d), 4096, 4);
        INFO("opacity " << opacity << ": " << m.mean << " +- " << m.standard_error);
        CHECK(std::fabs(m.mean - 0.8 * (1 - opacity) * (1 - opacity)) < 5 * m.standard_error + 1e-6);
    }
}
