#pragma once
// A scene of an experiment, ready to be measured.

#include "commands.h"
#include "experiment.h"

#include <koksma/integrators/render.h>
#include <koksma/measure/reference.h>

namespace koksma {

struct BenchScene {
    ExperimentScene what;
    Scene scene;
    RenderPlan plan;
    ReferenceKey key;
};

/// Loads and compiles. @throws Error, also for a crop that is not inside the film
[[nodiscard]] BenchScene open_scene(const ExperimentScene& what);

/// Scenes of an experiment, restricted to `only` where that is not empty. @throws UsageError for an unknown name
[[nodiscard]] std::vector<BenchScene> open_scenes(const Experiment& experiment, const std::vector<std::string>& only);

}  // namespace koksma
