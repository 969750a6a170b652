#pragma once
// Where the error of a scene comes from: groups of random decisions, each with independent numbers alone or with the sequence alone.

#include "bench_scene.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/reference.h>
#include <koksma/sampling/mixed_source.h>

#include <functional>
#include <string>
#include <vector>

namespace koksma {

/// Random decisions that are exchanged together.
struct SlotGroup {
    std::string name;  ///< "direction", "bounce 2", "direction, bounce 2"
    SlotSet slots;
};

/// A division of all slots: by what they decide, by bounce, or by both. Every slot is in one group of each.
struct Division {
    std::string by;  ///< "role", "bounce", "role and bounce"
    std::vector<SlotGroup> groups;
};

/// @param bounces  those from this one on are one group, "bounce N and later"
[[nodiscard]] std::vector<Division> divisions_of(const DimensionLayout& layout, std::size_t bounces);

/// What one group does to the error, measured both ways; MSEs corrected for the reference's noise, one value a replicate.
struct GroupBudget {
    std::vector<double> only;     ///< the group by the sequence, all others independent
    std::vector<double> all_but;  ///< the group independent, all others by the sequence
};

struct Budget {
    std::vector<double> independent, sequence;  ///< all slots one way
    std::vector<Division> divisions;
    std::vector<std::vector<GroupBudget>> groups;  ///< as in divisions
};

struct BudgetSettings {
    std::uint64_t spp = 64;
    int replicates = 16;
    std::size_t bounces = 4;
    std::uint64_t seed = 0;
    int threads = 0;
};

/// Renders everything. Groups with the same slots are rendered once.
/// @param sequence, independent  samplers; independent: "random"
/// @param progress  fraction done
[[nodiscard]] Budget measure_budget(const BenchScene& scene, const Reference& reference, const SamplerFactory& sequence,
                                    const SamplerFactory& independent, const BudgetSettings& settings,
                                    const std::function<void(double)>& progress);

/// 1 - MSE(a) / MSE(b) with its interval: the part of b's error that a lacks.
[[nodiscard]] Gain share(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace koksma
