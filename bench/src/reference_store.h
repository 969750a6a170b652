#pragma once
// Where references come from: those that ship, the user's cache, or a long render.

#include "experiment.h"

#include <koksma/integrators/render.h>
#include <koksma/measure/reference.h>
#include <koksma/sampling/registry.h>

#include <filesystem>
#include <functional>
#include <optional>

namespace koksma {

[[nodiscard]] ReferenceKey reference_key(const Scene& scene, const RenderPlan& plan, const std::string& name, PixelRect rect);

/// Folder of the user's own references: KOKSMA_REFERENCE_DIR, else XDG_CACHE_HOME/koksma/references, else ~/.cache/koksma/references.
[[nodiscard]] std::filesystem::path reference_cache();

/// The file that answers the key, if there is one: first in the cache, then among those that ship.
[[nodiscard]] std::optional<std::filesystem::path> find_reference(const ReferenceKey& key);

/// Renders both halves, replicate by replicate. After each the sums are kept in `steps`, if it is not empty, so that an interrupted
/// reference goes on from there with the same bits; removed at the end. @param progress  fraction done
/// @throws Error when the halves disagree by more than chance allows (8x8-block means, see agreement())
[[nodiscard]] Reference make_reference(const Scene& scene, const RenderPlan& plan, const ReferenceKey& key, const Experiment& experiment, std::uint64_t spp,
                                       const Registry& registry, int threads, const std::function<void(double)>& progress,
                                       const std::filesystem::path& steps = {});

/// Where an interrupted reference keeps its sums: beside its file.
[[nodiscard]] inline std::filesystem::path steps_of(std::filesystem::path file) { return file.replace_extension(".steps"); }

/// What a third render by another admissible estimator says of a reference.
struct ThirdOpinion {
    std::string estimator;           ///< in words
    double max_block_z = 0, limit = 0;  ///< of 8x8-block means against the reference; the z from which on they disagree
    /// The smallest bias that it would have seen, relative to the mean luminance of the reference: of a typical (median) block's mean, and of
    /// the whole image's mean.
    double block_bias = 0, image_bias = 0;
};

/// Renders it: independent random numbers, and Russian roulette from the first bounce on where the scene's begins later (or four bounces
/// later where it does not). It shares light sampling and weights with the reference, so what is wrong in those it cannot see.
/// @throws Error where block means disagree by more than chance allows
[[nodiscard]] ThirdOpinion third_opinion(const Scene& scene, const Reference& reference, std::uint64_t spp, int replicates, const Registry& registry, int threads,
                                         const std::function<void(double)>& progress);

/// Throws if the halves of a reference cannot be estimates of one image. @return the largest z of a block mean
double require_agreement(const Reference& reference);

}  // namespace koksma
