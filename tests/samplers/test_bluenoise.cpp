#include "film_draw.h"
#include "refusal.h"

#include <samplers/bluenoise.h>

#include <koksma_catch.h>

#include <cmath>
#include <cstdio>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

using namespace koksma;
using namespace koksma::test;

namespace {

/// The message that a text of keys is refused with.
std::string refused(const std::string& text) {
    return refusal([&] { (void)BlueNoiseTile::parse(text, "keys"); });
}

/// Mean squares of the errors of an image, as they are and after a Gaussian filter whose weights have a square sum of 1
/// (independent errors keep their mean square).
struct Power {
    double plain = 0, filtered = 0;
};
Power power(const std::vector<double>& e, int side, double sigma) {
    constexpr int kRadius = 4;
    double weight[2 * kRadius + 1], squares = 0;
    for (int k = -kRadius; k <= kRadius; ++k) squares += std::pow(weight[k + kRadius] = std::exp(-k * k / (2 * sigma * sigma)), 2);
    Power p;
    const auto at = [&](int x, int y) { return e[static_cast<std::size_t>(((y + side) % side) * side + (x + side) % side)]; };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            double sum = 0;
            for (int j = -kRadius; j <= kRadius; ++j)
                for (int i = -kRadius; i <= kRadius; ++i) sum += weight[i + kRadius] * weight[j + kRadius] * at(x + i, y + j);
            p.plain += at(x, y) * at(x, y) / (side * side);
            p.filtered += sum * sum / (squares * squares * side * side);
        }
    return p;
}

}  // namespace

TEST_CASE("The built-in tile has a key for each pixel, no value of which is much more common", "[unit][samplers]") {
    const BlueNoiseTile t = BlueNoiseTile::built_in();
    REQUIRE((t.width == 64 && t.height == 64 && t.layers == 1 && t.digits == 10 && t.samples == 64));
    int ones[20] = {};
    for (const std::uint32_t key : t.keys)
        for (int j = 0; j < 10; ++j) {
            ones[j] += (key >> j) & 1u;
            ones[10 + j] += (key >> (16 + j)) & 1u;
        }
    for (const int n : ones) REQUIRE(std::abs(n - 2048) < 6 * 32);
}

TEST_CASE("bluenoise: the samples of every pixel are nets in every pair of dimensions", "[unit][samplers]") {
    for (const int m : {0, 1, 3, 6, 9}) {
        const Points p = draw_film<BlueNoiseSampler>("bluenoise", {.width = 100, .height = 80, .spp = 1ull << m, .seed = 5, .pairs = 3, .x0 = 62, .y0 = 63, .columns = 3, .rows = 2});
        for (std::size_t d = 0; d < 6; d += 2)
            for (std::size_t pixel = 0; pixel < 6; ++pixel) REQUIRE(is_net(p, d, pixel << m, m));
    }
}

TEST_CASE("bluenoise: per pixel as padded Owen-scrambled Sobol'", "[unit][samplers]") {
    constexpr int kM = 4, kSeeds = 1500, kPixels = 4;
    const double n = 1 << kM, closed = (28.0 * kM / 3 + 16.0 / 9) / (256 * n * n * n);
    double sum[kPixels] = {};
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Points p = draw_film<BlueNoiseSampler>("bluenoise", {.width = 64, .height = 64, .spp = 1 << kM, .seed = seed, .pairs = 1, .x0 = 10, .y0 = 4, .columns = 2, .rows = 2});
        double e[kPixels] = {};
        for (std::size_t i = 0; i < p.count; ++i) e[i >> kM] += (p(0, i) + 0x1p-25 - 0.5) * (p(1, i) + 0x1p-25 - 0.5) / n;
        for (int k = 0; k < kPixels; ++k) sum[k] += e[k] * e[k] / kSeeds;
    }
    for (const double s : sum) REQUIRE(s / closed == Approx(1).margin(6 * 1.3 * std::sqrt(2.0 / kSeeds)).epsilon(0));
}

TEST_CASE("bluenoise: errors of neighbours cancel under every seed, and low frequencies have less of them", "[unit][samplers]") {
    constexpr int kSide = 64, kSeeds = 8;
    struct Integrand {
        const char* name;
        double mean;
        double (*f)(double, double);
        double most;  // filtered over plain mean square; measured: see the page of the sampler, and a margin of a third
    };
    const Integrand integrands[] = {{"x", 0.5, [](double x, double) { return x; }, 0.45},
                                    {"xy", 0.25, [](double x, double y) { return x * y; }, 0.45},
                                    {"quarter disk", 0.785398163397448, [](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; }, 0.8}};
    for (const std::uint64_t spp : {1ull, 4ull, 16ull, 64ull})
        for (const Integrand& g : integrands) {
            Power total;
            for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
                const Points p = draw_film<BlueNoiseSampler>("bluenoise", {.width = kSide, .height = kSide, .spp = spp, .seed = seed, .pairs = 2});
                std::vector<double> e(kSide * kSide, 0.0);
                for (std::size_t d : {std::size_t{0}, std::size_t{2}}) {  // the second pair has the layer again, moved
                    std::fill(e.begin(), e.end(), 0.0);
                    for (std::size_t i = 0; i < p.count; ++i) e[i / spp] += (g.f(p(d, i), p(d + 1, i)) - g.mean) / static_cast<double>(spp);
                    const Power one = power(e, kSide, 1);
                    total.plain += one.plain;
                    total.filtered += one.filtered;
                }
            }
            INFO(g.name << ", spp " << spp << ": filtered over plain " << total.filtered / total.plain);
            CHECK(total.filtered / total.plain < g.most);
        }
}

TEST_CASE("bluenoise: pixels a tile apart are not equal", "[unit][samplers]") {
    const Points a = draw_film<BlueNoiseSampler>("bluenoise", {.width = 256, .height = 256, .spp = 16, .x0 = 5, .y0 = 6, .columns = 1, .rows = 1});
    const Points b = draw_film<BlueNoiseSampler>("bluenoise", {.width = 256, .height = 256, .spp = 16, .x0 = 69, .y0 = 6, .columns = 1, .rows = 1});
    int equal = 0;
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        equal += a.values[k] == b.values[k];
        REQUIRE(static_cast<int>(a.values[k] * 1024) == static_cast<int>(b.values[k] * 1024));  // the ten digits of the keys
    }
    REQUIRE(equal < 3);
}

TEST_CASE("bluenoise: a table is read from a file, named by its content, and refused if it is another", "[unit][samplers]") {
    const auto path = (std::filesystem::temp_directory_path() / ("koksma_test_keys_" + std::to_string(::getpid()) + ".txt")).string();
    std::ofstream(path) << "// a tile of two pixels\n1, 2, 1, 1, 3, 8,\n5,131073\n";
    Registry registry;
    registry.add<BlueNoiseSampler>();
    const auto factory = registry.make("bluenoise:table=" + path);
    REQUIRE(factory->info().remark.find("2 x 1 pixels") != std::string::npos);
    REQUIRE(factory->options()["checksum"].size() == 16);
    REQUIRE(factory->name() == "bluenoise:randomize=owen,table=" + path + ",checksum=" + factory->options()["checksum"]);
    REQUIRE(registry.make(factory->name())->name() == factory->name());
    REQUIRE(contains(refusal([&] { (void)registry.make("bluenoise:checksum=0123456789abcdef,table=" + path); }), "0123456789abcdef was asked for"));
    REQUIRE(contains(refusal([&] { (void)registry.make("bluenoise:checksum=0123456789abcdef"); }), "no file"));
    REQUIRE(contains(refusal([&] { (void)registry.make("bluenoise:table=no/such/file"); }), "no/such/file: cannot be opened"));
    const Points p = draw_film(*factory, {.width = 4, .height = 2, .spp = 8});
    for (std::size_t pixel = 0; pixel < 8; ++pixel) REQUIRE(is_net(p, 0, 8 * pixel, 3));
    std::remove(path.c_str());
}

TEST_CASE("bluenoise: broken tables are refused with what is wrong", "[unit][samplers]") {
    REQUIRE(contains(refused("1,2,2,1,4"), "keys: has 5 numbers"));
    REQUIRE(contains(refused("2,2,2,1,4,8,0,0,0,0"), "version 2"));
    REQUIRE(contains(refused("1,3,2,1,4,8,0,0,0,0,0,0"), "a side of the tile is 3"));
    REQUIRE(contains(refused("1,2,2,1,4,8,0,0,0"), "has 3 keys; 2 x 2 pixels in 1 layers need 4"));
    REQUIRE(contains(refused("1,2,2,1,4,8\n0,0\n0,x"), "keys:3: 'x' is not a number"));
    REQUIRE(contains(refused("1,2,2,1,4,8,0,0,0,16"), "the key 16 has more than 4 digits"));
    REQUIRE(contains(refused("1,2,2,1,17,8,0,0,0,0"), "17 digits"));
}
