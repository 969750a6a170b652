#pragma once
// One path again, told vertex by vertex.

#include <koksma/plan/plan.h>
#include <koksma/sampling/sample_source.h>

#include <string>

namespace koksma {

/// Traces one camera sample with the reference kernel that has every effect and describes it: rays, hits, numbers drawn,
/// densities, weights, contributions, and the radiance, which is the one that render() adds for this sample, bit for bit
/// (with a batch kernel: but for those paths, fewer than one in 10^4, where Embree's packets and single rays differ at an edge).
/// @return  text of several lines
[[nodiscard]] std::string replay(const Scene& scene, const RenderPlan& plan, const SampleSource& source, SampleId id);

}  // namespace koksma
