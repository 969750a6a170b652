#pragma once
// Rendering with the lecture's estimators: an image for each term of the Neumann series, and the ledger.

#include <koksma/integrators/lecture/recursive.h>
#include <koksma/integrators/render.h>

#include <vector>

namespace koksma {

struct EstimateResult {
    Film film;
    std::vector<Film> terms;  ///< light that was scattered 0, 1, 2 ... times; the last: that often or more. Empty unless asked for
    Ledger ledger;
    double wall_seconds = 0.0, cpu_seconds = 0.0;
};

/// Renders all samples of a rectangle with indices [first, first + count). Same bytes for every number of threads.
/// @param plan      of make_plan(scene, integrator, settings)
/// @param source    bound to a plan with plan.layout; with branching, of a sequence (a set has no samples beyond its own)
/// @param terms     keep the images of the terms
/// @throws Error where branching would need more than 2^32 samples of the sequence
[[nodiscard]] EstimateResult render_estimate(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work,
                                             const EstimatorSettings& settings, bool terms = false, int threads = 0);

}  // namespace koksma
