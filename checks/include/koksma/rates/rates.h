#pragma once
// How the error of a sampler falls with the number of samples, over independent replicates.

#include <koksma/rates/integrands.h>

#include <koksma/sampling/registry.h>

#include <span>
#include <string>
#include <vector>

namespace koksma::convergence {

/// What is drawn.
struct RateSettings {
    std::vector<std::uint64_t> counts{};  ///< increasing; a sequence is drawn once up to the last and read off at each
    int replicates = 256;
    std::uint64_t first_seed = 1;  ///< replicate r has seed first_seed + r
    Pixel pixel{};
};

/// The error of one integrand at one number of samples, over all replicates.
struct ErrorAtCount {
    std::uint64_t count = 0;
    double rmse = 0;      ///< about the exact integral
    double bias_z = 0;    ///< mean error in units of its own standard error; 0 where all replicates agree exactly
    double kurtosis = 0;  ///< of the error about zero: 3 for a normal, 1.8 for a uniform one
};

struct Rates {
    std::string sampler;
    Integrand integrand;
    std::vector<ErrorAtCount> errors{};
    double slope = 0;        ///< of log2 RMSE against log2 N, least squares over all counts
    double slope_error = 0;  ///< its standard error, by the jackknife over replicates; NaN where a count has no error at all

    /// @throws std::out_of_range if the count was not drawn
    [[nodiscard]] const ErrorAtCount& at(std::uint64_t count) const;
};

/// Counts from 64 to `most` at which a sampler keeps its promises: powers of its base, powers of 4 where it wants squares, powers of
/// 2 where any will do. Fewer than two if its base leaves no more.
[[nodiscard]] std::vector<std::uint64_t> counts_for(const SamplerInfo& info, std::uint64_t most);

/// 2^first, 2^(first + step), .. 2^last.
[[nodiscard]] std::vector<std::uint64_t> powers_of_two(int first, int last, int step = 1);

/// The least-squares slope of log2 RMSE against log2 count.
[[nodiscard]] double fit_slope(std::span<const ErrorAtCount> errors);

/// Measures the rates of a sampler on integrands, all of which read the same points. The layout has slots of arity 2 (or one
/// slot of arity 1 if every integrand is one-dimensional): as many as the largest integrand needs.
/// A `set` is bound anew with spp = N for every count N; a `sequence` is bound once.
/// @throws Error if the sampler refuses a count
[[nodiscard]] std::vector<Rates> run_rates(const SamplerFactory& factory, std::span<const Integrand> integrands,
                                           const RateSettings& settings);

/// The same for one integrand.
[[nodiscard]] Rates run_rates(const SamplerFactory& factory, const Integrand& integrand, const RateSettings& settings);

}  // namespace koksma::convergence
