// RMSE against closed forms: no fitted constant. 1024 fixed seeds; the mean square error may differ from its expectation by
// six standard deviations, sqrt((kurtosis - 1) / R): 27 % for a normal error, 17 % for a uniform one.
// Derivations: a value of a stratum of width w has variance w^2 / 12; an indicator is wrong in one stratum, by the fraction
// phi of it. (x - 1/2)(y - 1/2) under Owen scrambling: Haar variance of x - 1/2 at level k is 4^-k / 16; the gain of a
// (0,m,2)-net is 0 for k1 + k2 <= m - 2, 2 for m - 1 and 1 from m on (Owen 1997, "Monte Carlo variance of scrambled net quadrature").

#include <koksma/rates/rates.h>

#include <koksma_catch.h>

#include <cmath>
#include <functional>

using namespace koksma;
using namespace koksma::convergence;

namespace {

constexpr int kReplicates = 1024;
constexpr double kNormal = 3.0, kUniform = 1.8;  // kurtosis

/// Second coordinate of one slot against the first of the next: does the padding of slots add error, or hide some?
constexpr Integrand kAcrossSlots{"across slots", 4, 0.0, [](const double* u) { return (u[1] - 0.5) * (u[2] - 0.5); }};
/// 1 where x < 1/pi, x from a pair.
constexpr Integrand kStepOfPair{"step of a pair", 2, kStepAt, kStep.value};

/// Mean square error and kurtosis of the error at N samples.
struct Expected {
    double mse, kurtosis;
};

struct ClosedForm {
    std::string_view sampler;
    Integrand integrand;
    std::function<Expected(double n)> at;
};

/// The error of one misjudged stratum of weight 1/N.
Expected one_stratum(double n) {
    const double phi = n * kStepAt - std::floor(n * kStepAt), variance = phi * (1 - phi);
    return {variance / (n * n), (1 - 3 * variance) / variance};
}
Expected owen_marginal(double n) { return {1 / (12 * n * n * n), kNormal}; }
Expected shifted_marginal(double n) { return {1 / (12 * n * n), kUniform}; }
Expected owen_bicen(double n) { return {(28 * std::log2(n) / 3 + 16.0 / 9) / (256 * n * n * n), kNormal}; }
/// Both coordinates stratified or not: variance 1/12 each, paired at random.
Expected unrelated_bicen(double n) { return {1 / (144 * n), kNormal}; }

std::vector<ClosedForm> closed_forms() {
    return {
        {"random", kLin2, [](double n) -> Expected { return {1 / (6 * n), kNormal}; }},
        {"random", kBicen2, unrelated_bicen},
        {"random", kAcrossSlots, unrelated_bicen},
        {"random", kQdisk2, [](double n) -> Expected { return {1 / (4 * n), kNormal}; }},

        {"sobol:randomize=owen", kLin1, owen_marginal},
        {"sobol:randomize=owen", kStep, one_stratum},
        {"sobol:randomize=owen", kLin2, [](double n) -> Expected { return {1 / (6 * n * n * n), kNormal}; }},
        {"sobol:randomize=owen", kBicen2, owen_bicen},
        {"sobol:randomize=owen", kBilin2, [](double n) -> Expected { return {owen_bicen(n).mse + 1 / (24 * n * n * n), kNormal}; }},
        {"sobol:randomize=owen-exact", kLin1, owen_marginal},
        {"sobol:randomize=owen-exact", kBicen2, owen_bicen},
        {"sobol:randomize=xor", kLin1, shifted_marginal},
        {"sobol:randomize=xor", kStep, one_stratum},

        {"halton:randomize=owen", kLin1, owen_marginal},
        {"halton:randomize=owen", kStep, one_stratum},
        {"halton:randomize=cp", kLin1, shifted_marginal},
        {"halton:randomize=cp", kStep, one_stratum},
        {"halton:randomize=digits", kLin1, shifted_marginal},

        {"stratified", kLin1, owen_marginal},
        {"stratified", kStep, one_stratum},
        {"stratified", kLin2, [](double n) -> Expected { return {1 / (6 * n * n), kNormal}; }},
        {"stratified", kTri2, [](double n) -> Expected { return {std::sqrt(n) / 4 / (n * n), kNormal}; }},
        {"stratified", kStepOfPair,
         [](double n) -> Expected {
             const double one = one_stratum(std::sqrt(n)).mse * n;  // a (1 - a) of the column that 1/pi cuts
             return {std::sqrt(n) * one / (n * n), kNormal};
         }},
        {"stratified", kBicen2,
         [](double n) -> Expected {
             const double s2 = 1 / (12 * n);  // variance within a cell
             return {((1 - 1 / n) * s2 / 6 + s2 * s2) / n, kNormal};
         }},
        {"stratified", kAcrossSlots, unrelated_bicen},
    };
}

}  // namespace

TEST_CASE("root mean square errors agree with their closed forms", "[convergence]") {
    Registry registry;
    register_samplers(registry);
    for (const ClosedForm& form : closed_forms()) {
        const Rates rates =
            run_rates(*registry.make(form.sampler), form.integrand, {.counts = {256, 1024, 4096}, .replicates = kReplicates, .first_seed = 5000});
        for (const ErrorAtCount& e : rates.errors) {
            const Expected expected = form.at(static_cast<double>(e.count));
            const double ratio = e.rmse * e.rmse / expected.mse, limit = 6 * std::sqrt((expected.kurtosis - 1) / kReplicates);
            INFO(rates.sampler << " on " << rates.integrand.name << " at N = " << e.count << ": mean square error is " << ratio
                               << " of its closed form, limit 1 +- " << limit << "; kurtosis " << e.kurtosis);
            CHECK(std::abs(ratio - 1) < limit);
            CHECK(std::abs(e.bias_z) < 6.5);
        }
    }
}
