// Directions drawn from a map against its density, and where its texels lie.

#include "chi_squared.h"
#include "render_scene.h"
#include "uniform.h"

#include <numbers>

using namespace koksma;
using namespace koksma::testing;

namespace {

float pdf_of(const EnvironmentMap& map, Vec3f d) { return environment_at(map.table(), environment_place(map.table(), d)).pdf_w; }
Vec3f radiance_of(const EnvironmentMap& map, Vec3f d) { return environment_at(map.table(), environment_place(map.table(), d)).radiance; }
struct Drawn {
    Vec3f d;
    float pdf_w = 0.0f;
};
Drawn draw(const EnvironmentMap& map, Vec2f u) {
    const Vec3f d = environment_direction(map.cells(), u);
    return {d, pdf_of(map, d)};
}


constexpr double kPiDouble = std::numbers::pi;

MapEnvironment test_map(int width, int height, std::uint32_t seed, const Matrix& to_world = Matrix(1.0)) {
    Uniform u(seed);
    std::vector<Rgb> texels;
    for (int i = 0; i < width * height; ++i) {
        const float v = u();
        texels.emplace_back(v < 0.3f ? Rgb(0.0f) : Rgb(v, v * v, 10.0f * v * v * v * v * v * v));
    }
    MapEnvironment m;
    m.image = image(width, height, std::move(texels));
    m.to_world = to_world;
    return m;
}

Vec3f direction(double turns, double polar) {  // +y up, azimuth from -z towards +x
    const double a = 2.0 * kPiDouble * turns, s = std::sin(polar);
    return {static_cast<float>(s * std::sin(a)), static_cast<float>(std::cos(polar)), static_cast<float>(-s * std::cos(a))};
}

}  // namespace

TEST_CASE("directions from a map follow its density, which integrates to 1", "[scenes]") {
    constexpr int kBinsZ = 20, kBinsPhi = 40, kSub = 24, kDraws = 400000;
    for (const auto& [w, h] : {std::pair{16, 8}, {7, 5}, {1, 1}, {3, 2}, {64, 32}})
        for (const Matrix& turn : {Matrix(1.0), rotated({0.6, 0.8, 0.0}, 70)}) {
            const EnvironmentMap map(test_map(w, h, 5, turn));
            std::vector<double> counts(kBinsZ * kBinsPhi), expected(counts.size());
            double integral = 0, mean = 0;
            for (int z = 0; z < kBinsZ; ++z)
                for (int p = 0; p < kBinsPhi; ++p) {
                    double sum = 0;
                    for (int i = 0; i < kSub; ++i)
                        for (int j = 0; j < kSub; ++j) {
                            const double c = -1.0 + 2.0 * (z + (i + 0.5) / kSub) / kBinsZ, phi = 2.0 * kPiDouble * (p + (j + 0.5) / kSub) / kBinsPhi;
                            const double s = std::sqrt(1.0 - c * c);
                            const Vec3f d{static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(c)};
                            sum += pdf_of(map, d);
                            mean += radiance_of(map, d).z;
                        }
                    const double mass = sum * 4.0 * kPiDouble / (kBinsZ * kBinsPhi * kSub * kSub);
                    expected[z * kBinsPhi + p] = mass * kDraws;
                    integral += mass;
                }
            mean /= kBinsZ * kBinsPhi * kSub * kSub;
            Uniform u(17);
            double radiance = 0, squares = 0;
            for (int i = 0; i < kDraws; ++i) {
                const Drawn s = draw(map, u.pair());
                REQUIRE(s.pdf_w >= 0.0f);
                if (!(s.pdf_w > 0.0f)) continue;
                const int z = std::clamp(static_cast<int>((s.d.z + 1.0f) * 0.5f * kBinsZ), 0, kBinsZ - 1);
                double turns = std::atan2(s.d.y, s.d.x) / (2.0 * kPiDouble);
                if (turns < 0) turns += 1.0;
                counts[z * kBinsPhi + std::min(kBinsPhi - 1, static_cast<int>(turns * kBinsPhi))] += 1;
                const double x = radiance_of(map, s.d).z / (4.0 * kPiDouble * s.pdf_w);
                radiance += x / kDraws;
                squares += x * x / kDraws;
            }
            // The density jumps at cells' borders, which the midpoint rule resolves to 1/24 of a bin: 1 % of a bin's mass would
            // be 10 counts of 500; the map of 64 x 32 has cells the size of bins.
            const double z = chi_squared_z(counts, expected), error = std::sqrt((squares - radiance * radiance) / kDraws);
            INFO(w << " x " << h << ": integral " << integral << " chi-squared z " << z << " mean " << radiance << " +- " << error << " by midpoints " << mean
                   << " by the map " << map.mean_radiance().z);
            CHECK(std::fabs(integral - 1.0) < 3e-3);
            CHECK(z < 6.0);
            CHECK(std::fabs(radiance - mean) < 5.0 * error + 3e-3 * mean);
        }
}

TEST_CASE("a texel lies where Mitsuba puts it", "[scenes]") {
    const MapEnvironment m = test_map(8, 5, 3);
    const EnvironmentMap map(m);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 8; ++x) {
            const Vec3f got = radiance_of(map, direction((x + 0.5) / 8.0, kPiDouble * y / 4.0));
            const Rgb want = m.image->texels[static_cast<std::size_t>(y * 8 + x)];
            INFO("column " << x << " row " << y);
            // A direction in float is 1e-7 of a turn off, 1e-5 of a cell: of radiance 10.
            if (y != 0 && y != 4) CHECK(std::fabs(got.z - want.z) < 1e-4f);
        }
    // Between two columns, and across the seam.
    const auto texel = [&](int x, int y) { return double{m.image->texels[static_cast<std::size_t>(y * 8 + x)].z}; };
    CHECK(std::fabs(radiance_of(map, direction(1.0 / 8.0, kPiDouble / 4.0)).z - 0.5 * (texel(0, 1) + texel(1, 1))) < 1e-4);
    CHECK(std::fabs(radiance_of(map, direction(0.0, kPiDouble / 4.0)).z - 0.5 * (texel(7, 1) + texel(0, 1))) < 1e-4);
}

TEST_CASE("no direction leaves the map", "[scenes]") {
    const EnvironmentMap map(test_map(16, 8, 2));
    for (const Vec3f d : {Vec3f{0, 1, 0}, Vec3f{0, -1, 0}, Vec3f{1, 0, 0}, Vec3f{-1, 0, 0}, Vec3f{0, 0, 1}, Vec3f{0, 0, -1}, Vec3f{-1e-10f, 0, -1},
                          Vec3f{1e-10f, 0, -1}, Vec3f{-1e-30f, 1, -1e-30f}, Vec3f{-0.0f, 0, -1}, Vec3f{0, 1.0000001f, 0}}) {
        CHECK(is_finite(radiance_of(map, d)));
        CHECK(std::isfinite(pdf_of(map, d)));
    }
    for (const float x : {0.0f, 0.5f, kOneMinusUlp})
        for (const float y : {0.0f, 0.5f, kOneMinusUlp}) CHECK(is_finite(environment_direction(map.cells(), Vec2f{x, y})));
}

TEST_CASE("a sample's density is positive and the radiance over it bounded, also by the poles of a large map", "[scenes]") {
    std::vector<Rgb> texels(64 * 4096, Rgb(0.0f));
    for (int x = 0; x < 64; ++x) texels[static_cast<std::size_t>(64 + x)] = Rgb(1.0f);
    MapEnvironment m;
    m.image = image(64, 4096, std::move(texels));
    const EnvironmentMap map(m);
    Uniform u(4);
    int lost = 0;
    double sum = 0;
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) {
        const Drawn s = draw(map, u.pair());
        if (!(s.pdf_w > 0.0f))
            ++lost;
        else
            sum += radiance_of(map, s.d).x / s.pdf_w / kDraws;
    }
    // Two rows of cells, tent of polar angle around row 1: 2 pi times the integral of tent sin.
    const double step = kPiDouble / 4095.0, expected = 2.0 * kPiDouble * step * step;
    INFO("lost " << lost << " of " << kDraws << ", integral " << sum << " expected " << expected);
    CHECK(lost < kDraws / 1000);
    CHECK(std::fabs(sum / expected - 1.0) < 1e-2);
}
