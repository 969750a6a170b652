#pragma once
// What replicate errors may look like, for simulations of coverage. Fixed seeds.

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace koksma::test {

using Generator = std::mt19937_64;

/// A positive random variable with mean 1.
struct Law {
    std::string name;
    std::function<double(Generator&)> draw;
};

/// A sum of squares of independent normals: what the MSE of an image of many pixels is. sd of one replicate, relative to the mean.
inline Law chi2_law(double relative_sd) {
    const double shape = 1 / (relative_sd * relative_sd);
    return {"chi2-like, sd " + std::to_string(relative_sd).substr(0, 4),
            [shape](Generator& g) { return std::gamma_distribution<double>(shape, 1 / shape)(g); }};
}

inline Law lognormal_law(double sigma) {
    return {"lognormal, sigma " + std::to_string(sigma).substr(0, 3),
            [sigma](Generator& g) { return std::exp(sigma * std::normal_distribution<double>()(g) - 0.5 * sigma * sigma); }};
}

/// Density ~ x^(-alpha - 1): no variance for alpha <= 2, no third moment for alpha <= 3.
inline Law pareto_law(double alpha) {
    return {"Pareto, alpha " + std::to_string(alpha).substr(0, 3), [alpha](Generator& g) {
                return (alpha - 1) / alpha * std::pow(1 - std::uniform_real_distribution<double>()(g), -1 / alpha);
            }};
}

inline std::vector<double> replicates(const Law& law, int n, double mean, Generator& g) {
    std::vector<double> x(static_cast<std::size_t>(n));
    for (double& v : x) v = mean * law.draw(g);
    return x;
}

/// The share of `repeats` for which covers(generator) is true.
template <class F>
double coverage(int repeats, F&& covers) {
    Generator g(20240229);
    int hits = 0;
    for (int i = 0; i < repeats; ++i) hits += covers(g) ? 1 : 0;
    return static_cast<double>(hits) / repeats;
}

}  // namespace koksma::test
