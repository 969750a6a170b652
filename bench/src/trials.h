#pragma once
// The renders of an experiment in the order in which they are made, and what tells a render's row from all others.

#include "measure.h"

#include <memory>
#include <string>
#include <vector>

namespace koksma {

/// One render: indices into the experiment's scenes and samplers.
struct PlannedTrial {
    std::size_t scene = 0, sampler = 0;
    Trial trial;
};

/// One part of an experiment that is spread over processes or machines; 1 of 1: all of it.
struct Shard {
    int part = 1, of = 1;
};
/// @param text  "k/n" with 1 <= k <= n. @throws UsageError
[[nodiscard]] Shard shard_of(const std::string& text);

/// Everything that an experiment renders, opened.
struct Run {
    Experiment experiment;
    std::vector<std::unique_ptr<SamplerFactory>> samplers;
    std::vector<BenchScene> scenes;
    std::vector<std::vector<SlotOrder>> orders;  ///< of layouts, by scene
};

/// All trials, or those of one shard. Scene by scene; within a scene replicate by replicate, so that whatever slows the machine down slows
/// all samplers. Shards have nearly equal numbers of samples. Trials point into the run's orders.
[[nodiscard]] std::vector<PlannedTrial> trials_of(const Run& run, Shard shard);

/// Samples of a pixel over all trials.
[[nodiscard]] double samples_of(const std::vector<PlannedTrial>& trials);

}  // namespace koksma
