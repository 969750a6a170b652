#pragma once
// One measured render, and what an experiment's renders cost.

#include "bench_scene.h"
#include "row.h"

namespace koksma {

/// Renders one replicate and compares it with the reference. @param image  receives the render, shape (height, width, 3)
[[nodiscard]] Row measure(const BenchScene& scene, const SamplerFactory& sampler, const Reference& reference, std::uint64_t spp, int replicate,
                          std::uint64_t base_seed, int threads, std::vector<float>& image);

/// Samples of a pixel of one scene by one sampler, over all counts and replicates.
[[nodiscard]] std::uint64_t paths_per_pixel(const Experiment& experiment);

/// Prints what an experiment would render, priced by small renders made now.
void print_price(const Experiment& experiment, const std::vector<BenchScene>& scenes, const Registry& registry, int threads);

}  // namespace koksma
