#pragma once
// Integrands with known integrals: what a sampler's rate is measured on.
// The names are those of bands.tsv. Its source gives rates but no formulas; a formula stands here only if the RMSE it gives
// (random, Owen-scrambled Sobol', jitter, xor at N = 1024) agrees with that table. Not matched, hence not here: ggauss (Genz
// Gaussians with unknown parameters) and light2, light4 (an area light behind a slanted edge); `gauss2`, `prodlin4`, `tri` and
// `qdisk` are in their classes.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace koksma::convergence {

/// A function on [0, 1)^dimensions and its integral.
struct Integrand {
    std::string_view name;
    std::uint8_t dimensions;
    double integral;
    double (*value)(const double* u);
};

/// Where `step` jumps: irrational, so that N * kStepAt is never a whole number.
inline constexpr double kStepAt = std::numbers::inv_pi;

namespace integrand_detail {
inline constexpr double kBoxX = std::numbers::inv_pi;
inline constexpr double kBoxY = 1.0 / std::numbers::e;

template <int D>
double mean_exp(const double* u) {
    double sum = 0;
    for (int d = 0; d < D; ++d) sum += std::exp(u[d]);
    return sum / D;
}

/// prod_i (1 + (u_i - 1/2) / i), i = 1..D: mean 1, interactions of every order, later dimensions matter less.
template <int D>
double linear_product(const double* u) {
    double product = 1;
    for (int d = 0; d < D; ++d) product *= 1 + (u[d] - 0.5) / (d + 1);
    return product;
}
}  // namespace integrand_detail

/// exp(x).
inline constexpr Integrand kExp1{"exp1", 1, std::numbers::e - 1, integrand_detail::mean_exp<1>};
/// 1 where x < 1/pi.
inline constexpr Integrand kStep{"step", 1, kStepAt, [](const double* u) { return u[0] < kStepAt ? 1.0 : 0.0; }};
/// x (closed-form checks).
inline constexpr Integrand kLin1{"lin1", 1, 0.5, [](const double* u) { return u[0]; }};
/// x + y.
inline constexpr Integrand kLin2{"lin", 2, 1.0, [](const double* u) { return u[0] + u[1]; }};
/// (exp(x) + exp(y)) / 2.
inline constexpr Integrand kAddExp2{"addexp", 2, std::numbers::e - 1, integrand_detail::mean_exp<2>};
/// (x - 1/2)(y - 1/2).
inline constexpr Integrand kBicen2{"bicen", 2, 0.0, [](const double* u) { return (u[0] - 0.5) * (u[1] - 0.5); }};
/// x y.
inline constexpr Integrand kBilin2{"bilin", 2, 0.25, [](const double* u) { return u[0] * u[1]; }};
/// exp(-x^2 - y^2); integral (sqrt(pi) erf(1) / 2)^2.
inline constexpr Integrand kGauss2{"gauss2", 2, 0.5577462853510336,
                                   [](const double* u) { return std::exp(-u[0] * u[0] - u[1] * u[1]); }};
/// 1 where x^2 + y^2 < 2/pi (a quarter disk of area 1/2; Christensen et al. 2018, "Progressive multi-jittered sample sequences").
inline constexpr Integrand kQdisk2{"qdisk", 2, 0.5, [](const double* u) {
                                       return u[0] * u[0] + u[1] * u[1] < 2 * std::numbers::inv_pi ? 1.0 : 0.0;
                                   }};
/// 1 where y < x.
inline constexpr Integrand kTri2{"tri", 2, 0.5, [](const double* u) { return u[1] < u[0] ? 1.0 : 0.0; }};
/// 1 where x < 1/pi and y < 1/e.
inline constexpr Integrand kBox2{"box", 2, integrand_detail::kBoxX* integrand_detail::kBoxY,
                                 [](const double* u) { return u[0] < integrand_detail::kBoxX && u[1] < integrand_detail::kBoxY ? 1.0 : 0.0; }};
/// The mean of exp(x_i) over six dimensions.
inline constexpr Integrand kAddExp6{"addexp", 6, std::numbers::e - 1, integrand_detail::mean_exp<6>};
inline constexpr Integrand kProdlin4{"prodlin", 4, 1.0, integrand_detail::linear_product<4>};
inline constexpr Integrand kProdlin6{"prodlin", 6, 1.0, integrand_detail::linear_product<6>};

/// The minimal set: with these, a sampler's rates tell it from every other. From simple to hard; more than one dimension unless
/// the name says otherwise. `exp1` and `step` are the ones to draw from a 1-D slot.
inline constexpr std::array kOneDimensional{kExp1, kStep};
inline constexpr std::array kMultiDimensional{kLin2, kAddExp2, kBicen2, kBilin2, kGauss2, kQdisk2, kTri2, kBox2, kProdlin4, kAddExp6, kProdlin6};

}  // namespace koksma::convergence
