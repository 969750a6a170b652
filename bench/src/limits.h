#pragma once
// The measurements of `koksma limits`, one scene at a time. Each prints its table and returns its figures.

#include "scene_setup.h"

#include <nlohmann/json_fwd.hpp>

namespace koksma {

/// T/E1 and T/Eown. @param ok  false if the kernel traces other rays than the reference kernel
[[nodiscard]] nlohmann::ordered_json measure_distance(const LimitsCommand& command, SceneSetup& setup, bool& ok);

/// Speed-up by threads, beside that of pure arithmetic.
[[nodiscard]] nlohmann::ordered_json measure_scaling(const LimitsCommand& command, const SceneSetup& setup);

/// Time and memory against samples per pixel, against pixels; how parallel the BVH is built.
[[nodiscard]] nlohmann::ordered_json measure_growth(const LimitsCommand& command, SceneSetup& setup);

}  // namespace koksma
