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
    std::uint64_t prefix_of = 0;       ///< not 0: the first spp samples of a render of so many
};

/// FLIP, the dearest of the metrics, is taken of the first replicates only: it has no slope, and its spread is small.
inline constexpr int kFlipReplicates = 4;
[[nodiscard]] inline bool with_flip(const Trial& t) noexcept { return t.replicate < kFlipReplicates && t.layout == 0 && t.prefix_of == 0; }

/// The seed of a trial's render: of each its own.
[[nodiscard]] std::uint64_t seed_of(const BenchScene& scene, const SamplerFactory& sampler, const Trial& trial, std::uint64_t base_seed);

/// What a trial's row says before it is rendered: all that key_of() reads.
[[nodiscard]] Row identity_of(const BenchScene& scene, const SamplerFactory& sampler, const Judge& judge, const Trial& trial, std::uint64_t base_seed, int threads);

/// Renders one replicate and compares it with the reference. @param image  receives the render, shape (height, width, 3)
[[nodiscard]] Row measure(const BenchScene& scene, const SamplerFactory& sampler, const Judge& judge, const Trial& trial, std::uint64_t base_seed,
                          int threads, std::vector<float>& image);

}  // namespace koksma
