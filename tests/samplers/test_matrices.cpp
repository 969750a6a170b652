#include "film_draw.h"
#include "matrix_file.h"
#include "refusal.h"

#include <samplers/matrices.h>
#include <samplers/sobol.h>

#include <koksma_catch.h>

#include <cmath>
#include <string>

using namespace koksma;
using namespace koksma::test;

namespace {

std::string refused(const std::string& text) {
    return refusal([&] { (void)GeneratorMatrices::parse(text, "m"); });
}

}  // namespace

TEST_CASE("matrices: the built-in ones are those of Sobol'", "[unit][samplers]") {
    const Draw what{.count = 512, .first = 1ull << 40, .seed = 4, .dimensions = 64};
    REQUIRE(draw<MatricesSampler>("matrices:randomize=none", what).values == draw<SobolSampler>("sobol:randomize=none", what).values);
    REQUIRE(draw<MatricesSampler>("matrices", what).values != draw<SobolSampler>("sobol", what).values);  // a scramble of its own
}

TEST_CASE("matrices: base 2 from a file is bit-exact", "[unit][samplers]") {
    // Dimensions 0 and 1 of Sobol': the Pascal matrices of base 2.
    const File file(faure_text(2, 2, 32, 20));
    const Draw what{.count = 4096, .dimensions = 2};
    REQUIRE(draw<MatricesSampler>("matrices:randomize=none,file=" + file.path, what).values == draw<SobolSampler>("sobol:randomize=none", what).values);
    for (const char* randomize : {"digits", "owen"}) {
        const Points p = draw<MatricesSampler>("matrices:file=" + file.path + ",randomize=" + randomize, what);
        for (int m = 0; m <= 12; ++m) REQUIRE(is_net(p, 0, 0, m));
    }
}

TEST_CASE("matrices: Faure in base 3 and 5 is a net, scrambled or not, and every dimension is stratified", "[unit][samplers]") {
    for (const auto& [b, m] : {std::pair{3u, 6u}, {5u, 4u}}) {
        const File file(faure_text(b, b, 18, 12));
        std::uint64_t n = 1;
        for (std::uint32_t k = 0; k < m; ++k) n *= b;
        for (const char* randomize : {"none", "digits", "owen"})
            for (const std::uint64_t block : {0ull, 4ull}) {
                const Points p = draw<MatricesSampler>("matrices:randomize=" + std::string(randomize) + ",file=" + file.path,
                                                       {.count = n, .first = block * n, .seed = 8, .dimensions = b});
                for (std::size_t d = 0; d < b; ++d) {
                    REQUIRE(one_per_stratum(p, d, n));
                    for (std::uint64_t columns = b; columns < n; columns *= b) REQUIRE(one_per_cell(p, d, columns, (d + 1) % b, n / columns));
                }
            }
    }
}

TEST_CASE("matrices: unscrambled values in base 3 are the digits' fractions", "[unit][samplers]") {
    const File file(faure_text(3, 3, 12, 12));
    const GeneratorMatrices m = GeneratorMatrices::parse(faure_text(3, 3, 12, 12), "m");
    const Points p = draw<MatricesSampler>("matrices:randomize=none,file=" + file.path, {.count = 200, .first = 12345, .dimensions = 3});
    for (std::uint32_t d = 0; d < 3; ++d)
        for (std::uint32_t i = 0; i < 200; ++i) {
            std::uint64_t numerator = 0, denominator = 1;
            for (std::uint32_t r = 0; r < 12; ++r) {
                std::uint32_t digit = 0;
                for (std::uint32_t c = 0, n = 12345 + i; c < 12; ++c, n /= 3) digit += n % 3 * m.entry(d, r, c);
                numerator = 3 * numerator + digit % 3;
                denominator *= 3;
            }
            REQUIRE(std::abs(p(d, i) - static_cast<double>(numerator) / static_cast<double>(denominator)) < 0x1p-24);
        }
}

TEST_CASE("matrices: owen in base 3 has the variance of nested scrambling", "[unit][samplers]") {
    // Mean of x at N = 3^m: 1 / (12 N^3).
    const File file(faure_text(3, 3, 18, 12));
    Registry registry;
    registry.add<MatricesSampler>();
    const auto factory = registry.make("matrices:file=" + file.path);
    constexpr int kSeeds = 1500, kN = 81;
    double sum[4] = {};
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const Points p = draw_film(*registry.make("matrices:pad=2,file=" + file.path), {.width = 1, .height = 1, .spp = kN, .seed = seed});
        for (std::size_t d = 0; d < 4; ++d) {
            double e = 0;
            for (std::size_t i = 0; i < kN; ++i) e += (p(d, i) + 0x1p-25 - 0.5) / kN;
            sum[d] += e * e / kSeeds;
        }
    }
    for (const double s : sum) REQUIRE(s * 12 * std::pow(kN, 3) == Approx(1).margin(6 * std::sqrt(2.0 / kSeeds)).epsilon(0));
    REQUIRE(factory->info().max_samples == 531441);
    REQUIRE(factory->info().good_counts.text() == "powers of 3");
}

TEST_CASE("matrices: more dimensions or samples than the file has are refused, or padded if asked for", "[unit][samplers]") {
    const File file(faure_text(3, 3, 8, 8));
    Registry registry;
    registry.add<MatricesSampler>();
    const auto bind = [&](const std::string& options, std::uint64_t spp, std::uint32_t pairs) {
        return refusal([&] { (void)registry.make("matrices:file=" + file.path + options)->bind({.spp = spp, .layout = film_layout(pairs, false)}); });
    };
    REQUIRE(bind("", 6561, 1) == "accepted");
    REQUIRE(contains(bind("", 6562, 1), "has 6561 samples per pixel at most; 6562"));
    REQUIRE(contains(bind("", 9, 2), "has 3 dimensions; the plan has 4"));
    REQUIRE(bind(",pad=2", 9, 20) == "accepted");
    REQUIRE(bind(",pad=all", 9, 20) == "accepted");
    REQUIRE(contains(bind(",pad=4", 9, 20), "has 3 dimensions; pad=4 needs 4"));
    REQUIRE(contains(bind(",pad=3", 9, 20), "pad=3 is not one of its values: none, 2, 4, all"));
    // Padded sets are nets too, and no set has the points of another.
    const File large(faure_text(3, 3, 18, 12));
    for (const char* options : {"randomize=none,pad=2,file=", "randomize=owen,pad=2,file=", "randomize=owen,pad=all,file="}) {
        const Points p = draw_film<MatricesSampler>("matrices:" + std::string(options) + large.path, {.width = 1, .height = 1, .spp = 81, .pairs = 4});
        for (std::size_t d = 0; d < 8; d += 2) {
            REQUIRE(one_per_cell(p, d, 9, d + 1, 9));
            for (std::size_t e = d + 2; e < 8; e += 2) {
                int equal = 0;
                for (std::size_t i = 0; i < 81; ++i) equal += p(d, i) == p(e, i);
                REQUIRE(equal < 20);
            }
        }
    }
}

TEST_CASE("matrices: the canonical name carries the checksum of the file, whose name may have ':' and '='", "[unit][samplers]") {
    const File file(faure_text(2, 2, 8, 8));
    Registry registry;
    registry.add<MatricesSampler>();
    const auto factory = registry.make("matrices:file=" + file.path);
    REQUIRE(contains(factory->name(), ",checksum=" + factory->options()["checksum"]));
    REQUIRE(contains(factory->info().remark, "base 2, 2 dimensions, 8 rows, 8 columns"));
    REQUIRE(registry.make(factory->name())->name() == factory->name());
    std::ofstream(file.path) << faure_text(2, 2, 9, 8);
    REQUIRE(contains(refusal([&] { (void)registry.make(factory->name()); }), "was asked for"));
}

TEST_CASE("matrices: bad files are refused with line and number", "[unit][samplers]") {
    const std::string head = "koksma-matrices 1\nbase 3\ndimensions 1\nrows 2\ncolumns 2\n";
    REQUIRE(refused(head + "matrix 0\n1 0\n0 1\n") == "accepted");
    REQUIRE(refused(head + "matrix 0\n0 1\n1 0\n") == "accepted");
    REQUIRE(contains(refused("hello\n"), "m:1: expected 'koksma-matrices 1'"));
    REQUIRE(contains(refused("koksma-matrices 2\n"), "m:1: expected"));
    REQUIRE(contains(refused("koksma-matrices 1\nbase 4\n"), "m:2: base 4 is not a prime"));
    REQUIRE(contains(refused("koksma-matrices 1\nbase 3\nbase 3\n"), "m:3: 'base' is given twice"));
    REQUIRE(contains(refused("koksma-matrices 1\nbasis 3\n"), "m:2: 'basis' is not one of base, dimensions, rows, columns"));
    REQUIRE(contains(refused("koksma-matrices 1\nbase 3\ndimensions 0\n"), "m:3: dimensions is 0"));
    REQUIRE(contains(refused("koksma-matrices 1\nbase 3\ndimensions 1\nrows 2\ncolumns 3\n"), "m:5: 2 rows and 3 columns"));
    REQUIRE(contains(refused(head + "matrix 0\n1 0\n0 3\n"), "m:8: row 1 of matrix 0: the entry 3 is not a digit in base 3"));
    REQUIRE(contains(refused(head + "matrix 0\n1 0\n0\n"), "m:8: row 1 of matrix 0 has 1 entries; there are 2 columns"));
    REQUIRE(contains(refused(head + "matrix 0\n1 0 1\n0 1\n"), "m:7: row 0 of matrix 0 has 3 entries"));
    REQUIRE(contains(refused(head + "matrix 0\n1 2\n2 1\n"), "m:6: matrix 0 is singular: column 1"));
    REQUIRE(contains(refused(head + "matrix 0\n1 0\n0 x\n"), "m:8: 'x' is not a whole number"));
    REQUIRE(contains(refused(head + "matrix 1\n1 0\n0 1\n"), "m:6: expected 'matrix 0'"));
    REQUIRE(contains(refused(head + "matrix 0\n1 0\n"), "the file ends in matrix 0, which has 1 of 2 rows"));
    REQUIRE(contains(refused(head), "the file ends before matrix 0 of 1"));
    REQUIRE(contains(refused(head + "matrix 0\n1 0\n0 1\n1 1\n"), "m:9: expected the end of the file"));
    REQUIRE_FALSE(GeneratorMatrices::parse(head + "matrix 0\n0 1\n1 0\n", "m").stratified);
    REQUIRE(GeneratorMatrices::parse(head + "matrix 0\r\n2 1\r\n0 1\r\n", "m").stratified);
}
