#pragma once
// The robustness ladder: scenes with known answers in which one number grows to where float ends.

#include <koksma/measure/statistics.h>
#include <koksma/sampling/registry.h>
#include <koksma/scene/description.h>

#include <cstdint>
#include <string>
#include <vector>

namespace koksma {

/// A rung: one scene of one pixel or some, all of which see the same radiance.
struct LadderStep {
    double x = 0;  ///< what grows
    SceneDescription scene;
    double expected = 1;       ///< radiance in closed form
    std::uint64_t spp = 1024;  ///< per pixel and replicate
    std::uint64_t first = 0;   ///< index of the first sample
    int replicates = 8;
    std::string sampler = "sobol:randomize=owen";
};

struct Ladder {
    std::string name, title, axis;
    std::string answer;       ///< where the closed form comes from
    double tolerance = 1e-3;  ///< relative, noise excluded
    std::vector<Technique> techniques;
    std::vector<LadderStep> steps;
};

/// All ladders, with samples for some minutes; `quick`: a sixteenth of them.
[[nodiscard]] std::vector<Ladder> ladders(bool quick);

/// What a technique gave at a step.
struct LadderResult {
    double error = 0;           ///< relative
    double half_width = 0;      ///< of its 99 % interval, t over replicates
    std::uint64_t invalid = 0;  ///< samples
    [[nodiscard]] bool holds(double tolerance) const noexcept {
        return invalid == 0 && error <= tolerance + half_width && -error <= tolerance + half_width;
    }
    /// False if the noise hides errors of ten times the tolerance.
    [[nodiscard]] bool tells(double tolerance) const noexcept { return half_width <= 10.0 * tolerance; }
};

[[nodiscard]] LadderResult climb(const LadderStep& step, Technique technique, const Registry& registry, int threads);

/// Paths whose every number is at or near an end of [0, 1): scenes, samples and how many of them were invalid or beyond the brightest
/// light.
struct ExtremeResult {
    std::string scene;
    std::uint64_t samples = 0, invalid = 0;
    double brightest = 0;  ///< mean of a pixel
};
[[nodiscard]] std::vector<ExtremeResult> sweep_extremes(std::uint64_t samples, int threads);

}  // namespace koksma
