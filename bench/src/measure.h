#pragma once
// One measured render, and what an experiment's renders cost.

#include "judge.h"
#include "row.h"

#include <koksma/sampling/permuted_source.h>

namespace koksma {

/// One of an experiment's renders of a scene by a sampler.
struct Trial {
    std::uint64_t spp = 1;
    int replicate = 0;
    int layout = 0;
    const SlotOrder* order = nullptr;  ///< of the layout; not read for layout 0
};

/// FLIP, the dearest of the metrics, is taken of the first replicates only: it has no slope, and its spread is small.
inline constexpr int kFlipReplicates = 4;

/// The seed of a trial's render: of each its own.
[[nodiscard]] std::uint64_t seed_of(const BenchScene& scene, const SamplerFactory& sampler, const Trial& trial, std::uint64_t base_seed);

/// Renders one replicate and compares it with the reference. @param image  receives the render, shape (height, width, 3)
[[nodiscard]] Row measure(const BenchScene& scene, const SamplerFactory& sampler, const Judge& judge, const Trial& trial, std::uint64_t base_seed,
                          int threads, std::vector<float>& image);

/// Renders and samples of a pixel of one scene by one sampler, over all counts, replicates and layouts.
struct Amount {
    std::uint64_t renders = 0, paths_per_pixel = 0;
};
[[nodiscard]] Amount amount_of(const Experiment& experiment, const SamplerFactory& sampler);

/// Prints what an experiment would render, priced by small renders made now.
void print_price(const Experiment& experiment, const std::vector<BenchScene>& scenes, const std::vector<std::unique_ptr<SamplerFactory>>& samplers, const Registry& registry,
                 int threads);

}  // namespace koksma
