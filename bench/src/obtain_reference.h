#pragma once
// The reference of a scene that is measured: one that is there, or one that is rendered now and kept.

#include "bench_scene.h"

namespace koksma {

/// @param e  says how a reference is made
/// @throws Error where its halves disagree or it is stale
[[nodiscard]] Reference obtain_reference(const Experiment& e, const BenchScene& s, const Registry& registry, int threads);

}  // namespace koksma
