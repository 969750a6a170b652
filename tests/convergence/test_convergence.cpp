// Measured rates against the bands of correct samplers (bands.tsv), two-sided: too good is as wrong as too bad.
// 256 fixed seeds. A band is six standard deviations wide on either side, those of the table's own estimate included.

#include "bands.h"

#include <koksma_catch.h>

#include <array>
#include <cstdio>

using namespace koksma;
using namespace koksma::convergence;

namespace {

constexpr double kBiasLimit = 6.5;

const Band& band(const std::string& sampler, const Integrand& f) {
    static const std::vector<Band> all = load_bands(KOKSMA_SOURCE_DIR "/tests/convergence/bands.tsv");
    for (const Band& b : all)
        if (b.sampler == sampler && b.integrand == f.name && b.dimensions == f.dimensions) return b;
    throw std::runtime_error("bands.tsv has no row " + sampler + ", " + std::string(f.name));
}

std::unique_ptr<SamplerFactory> make(std::string_view spec) {
    Registry registry;
    register_samplers(registry);
    return registry.make(spec);
}

constexpr auto& kOneD = kOneDimensional;
constexpr std::array kTwoD{kLin2, kAddExp2, kBicen2, kBilin2, kGauss2, kQdisk2, kTri2, kBox2};
/// All that read at least two dimensions: dimensions 0 and 1 are the same whatever follows them.
constexpr auto& kUpToSixD = kMultiDimensional;

/// Compares the rates of a sampler with the rows of the table named `rows`.
/// @param last   log2 of the largest N, 12 or 14
/// @param step   of log2 N; 2 for sets that want squares
void check_bands(std::string_view spec, const std::string& rows, std::span<const Integrand> integrands, int last, int step = 1) {
    const auto factory = make(spec);
    for (const Rates& rates : run_rates(*factory, integrands, {.counts = powers_of_two(6, last, step)})) {
        const Band& b = band(rows, rates.integrand);
        INFO(rates.sampler << " on " << rates.integrand.name << ", " << int{rates.integrand.dimensions} << " dimensions, against " << rows);
        const double expected = last == 14 ? b.slope_6_14 : b.slope_6_12, sd = last == 14 ? b.sd_6_14 : b.sd_6_12;
        // Every other count: the fit has 1.22 times the standard deviation (sums of squares 60 and 40 for 2^6..2^14).
        const double width = slope_width(sd, step == 1 ? 1.0 : 1.22);
        INFO("slope " << rates.slope << ", expected " << expected << " +- " << width);
        CHECK(std::abs(rates.slope - expected) < width);
        const double level = std::log2(rates.at(1024).rmse);
        INFO("log2 RMSE at N = 1024: " << level << ", expected " << b.level << " +- " << b.level_width());
        CHECK(std::abs(level - b.level) < b.level_width());
        for (const std::uint64_t n : {256u, 1024u, 4096u}) {
            INFO("bias at N = " << n << ": z = " << rates.at(n).bias_z);
            CHECK(std::abs(rates.at(n).bias_z) < kBiasLimit);
        }
    }
}

}  // namespace

TEST_CASE("random converges as N^-1/2", "[convergence]") {
    check_bands("random", "random", kOneD, 14);
    check_bands("random", "random", kUpToSixD, 14);
}

TEST_CASE("rotated Halton converges at its rates", "[convergence]") {
    check_bands("halton:randomize=cp", "halton_cp", kOneD, 14);
    check_bands("halton:randomize=cp", "halton_cp", kUpToSixD, 14);
}

TEST_CASE("digit-permuted Halton converges at its rates", "[convergence]") {
    check_bands("halton:randomize=digits", "halton_rdp", kOneD, 14);
    check_bands("halton:randomize=digits", "halton_rdp", kUpToSixD, 14);
}

TEST_CASE("Owen-scrambled Halton converges at its rates", "[convergence]") {
    check_bands("halton:randomize=owen", "halton_owen", kOneD, 14);
    check_bands("halton:randomize=owen", "halton_owen", kUpToSixD, 14);
}

TEST_CASE("digitally shifted Sobol' converges at its rates", "[convergence]") {
    check_bands("sobol:randomize=xor", "sobol_xor", kOneD, 14);
    check_bands("sobol:randomize=xor", "sobol_xor", kUpToSixD, 14);
}

TEST_CASE("Owen-scrambled Sobol' converges at its rates", "[convergence]") {
    check_bands("sobol:randomize=owen", "sobol_owen", kOneD, 14);
    check_bands("sobol:randomize=owen", "sobol_owen", kUpToSixD, 14);
}

TEST_CASE("Sobol' scrambled by a tree converges at the rates of the hash", "[convergence]") {
    constexpr std::array kFew{kAddExp2, kBicen2, kGauss2, kQdisk2, kProdlin4};
    check_bands("sobol:randomize=owen-exact", "sobol_owen", kFew, 12);
}

TEST_CASE("stratified converges at the rates of jitter at square counts", "[convergence]") {
    check_bands("stratified", "jitter", kOneD, 14, 2);
    check_bands("stratified", "jitter", kTwoD, 14, 2);
}

TEST_CASE("Latin hypercubes converge at their rates", "[convergence]") {
    check_bands("lhs", "lhs", kOneD, 12);
    check_bands("lhs", "lhs", kUpToSixD, 12);
}

TEST_CASE("multi-jitter converges at its rates at square counts", "[convergence]") {
    check_bands("multijitter:order=independent", "mj2", kTwoD, 14, 2);
}

TEST_CASE("padded Sobol' converges as the joint sequence in pairs and as random numbers beyond", "[convergence]") {
    check_bands("sobol-padded", "sobol_pad2", kOneD, 12);
    check_bands("sobol-padded", "sobol_pad2", kUpToSixD, 12);
}

/// In pairs only: the slope of a single multiple of an irrational depends on where its sequence starts.
TEST_CASE("pairs of the Kronecker sequence converge at their rates", "[convergence]") {
    check_bands("kronecker", "kron", kTwoD, 12);
}

/// The same 6 dimensions: a product, whose interactions reach across slots, and a sum, which has none. (sobol-4d is here what it is in pairs:
/// in a plain layout every slot is a group of its own.) By hand: koksma rates --set joint-padded
TEST_CASE("joint Sobol' keeps its rate in six dimensions where padded sets fall back to N^-1/2", "[convergence]") {
    constexpr std::array kSix{kProdlin6, kAddExp6};
    std::printf("%-32s %24s %24s\n", "slopes, N = 64 .. 16384", "product of 6, +- 1.96 se", "sum of 6, +- 1.96 se");
    const auto measured = [&](std::string_view spec) {
        const std::vector<Rates> rates = run_rates(*make(spec), kSix, {.counts = powers_of_two(6, 14)});
        std::printf("%-32s", rates[0].sampler.c_str());
        for (const Rates& r : rates) std::printf(" %15.3f +- %.3f", r.slope, 1.96 * r.slope_error);
        std::printf("\n");
        return rates;
    };
    const std::vector<Rates> joint = measured("sobol:randomize=owen"), pairs = measured("sobol-padded"), fours = measured("sobol-4d");
    const std::vector<Rates> random = measured("random");
    std::fflush(stdout);
    constexpr double kSd = 6;  // standard errors of a slope
    CHECK(joint[0].slope + kSd * joint[0].slope_error < -1.1);
    CHECK(std::abs(pairs[0].slope + 0.5) < kSd * pairs[0].slope_error);
    CHECK(fours[0].slope - kSd * fours[0].slope_error > -1.1);
    CHECK(std::abs(random[0].slope + 0.5) < kSd * random[0].slope_error);
    // Without interactions padding costs nothing.
    for (const std::vector<Rates>& r : {joint, pairs, fours}) CHECK(std::abs(r[1].slope + 1.5) < kSd * r[1].slope_error + 0.02);
}

TEST_CASE("Owen-scrambled Sobol' falls to N^-1 one sample short of a power of two", "[convergence]") {
    RateSettings settings;
    for (const std::uint64_t n : powers_of_two(6, 14)) settings.counts.push_back(n - 1);
    constexpr std::array kSmooth{kLin2, kAddExp2, kGauss2};
    for (const Rates& rates : run_rates(*make("sobol:randomize=owen"), kSmooth, settings)) {
        INFO(rates.integrand.name << ": slope " << rates.slope << ", expected -1.00 +- .08");
        CHECK(std::abs(rates.slope + 1.0) < 0.08);
    }
}
