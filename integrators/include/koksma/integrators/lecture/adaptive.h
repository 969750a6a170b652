#pragma once
// Adaptive sampling with sequences: a pilot says where the noise is, and every pixel gets a good count of samples.

#include <koksma/integrators/render.h>
#include <koksma/sampling/registry.h>

#include <cstdint>
#include <vector>

namespace koksma {

/// As render(), by the same kernels, but with a number of samples for each pixel of its own, counts[row * width + column]; 0: none.
/// Same bytes for every number of threads.
[[nodiscard]] RenderResult render_counts(const Scene& scene, const RenderPlan& plan, const SampleSource& source, PixelRect rect,
                                         const std::vector<std::uint64_t>& counts, int threads = 0);

enum class AdaptiveMode : std::uint8_t {
    two_stage,  ///< the pilot is discarded and the picture made under a fresh scramble: unbiased
    one_stage,  ///< the pilot is part of the picture: pixels whose pilot happened to be dark and calm get few other samples, so it is
                ///< biased
};

struct AdaptiveSettings {
    AdaptiveMode mode = AdaptiveMode::two_stage;
    std::uint64_t average_spp = 64;  ///< that may be traced in all, pilot included
    /// The pilot: so many independent scrambles of so many samples. The variance between scrambles is that of the sequence; the variance
    /// between samples of one scramble says little of it.
    std::uint64_t pilot_scrambles = 4, pilot_spp = 4;
    std::uint64_t least_spp = 4, most_spp = 1024;  ///< of a pixel, besides the pilot
    std::uint64_t seed = 0;
};

struct AdaptiveResult {
    Film film;
    std::vector<std::uint64_t> counts;  ///< samples of each pixel besides the pilot's, good counts of the sampler
    double spent_spp = 0.0;             ///< traced per pixel in all, at most average_spp
    std::uint64_t invalid_samples = 0;
};

/// Counts in proportion to the noise (Neyman's allocation, which minimises the sum of the variances), rounded to allowed ones.
/// @param noise    standard deviation of each pixel; all zero: all alike
/// @param allowed  ascending
/// @param average  that their mean may not exceed
/// Source: Neyman 1934, "On the two different aspects of the representative method", JRSS 97
[[nodiscard]] std::vector<std::uint64_t> allocate(const std::vector<double>& noise, const std::vector<std::uint64_t>& allowed,
                                                  double average);

/// @throws Error for a sampler whose samples depend on their number, and where the average leaves too little beside the pilot
[[nodiscard]] AdaptiveResult render_adaptive(const Scene& scene, const RenderPlan& plan, const SamplerFactory& sampler, PixelRect rect,
                                             const AdaptiveSettings& settings, int threads = 0);

}  // namespace koksma
