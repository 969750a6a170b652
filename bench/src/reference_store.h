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

/// Renders both halves. @param progress  fraction done
/// @throws Error when the halves disagree by more than chance allows (8x8-block means, see agreement())
[[nodiscard]] Reference make_reference(const Scene& scene, const RenderPlan& plan, const ReferenceKey& key, const Experiment& experiment, std::uint64_t spp,
                                       const Registry& registry, int threads, const std::function<void(double)>& progress);

/// Throws if the halves of a reference cannot be estimates of one image. @return the largest z of a block mean
double require_agreement(const Reference& reference);

}  // namespace koksma
