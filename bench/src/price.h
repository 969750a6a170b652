#pragma once
// What a run costs, before it is run.

#include "trials.h"

#include <filesystem>

namespace koksma {

/// Prints what would be rendered, priced by small renders by each sampler made now. Rows that are in the folder cost nothing.
void print_price(const Run& run, const std::vector<PlannedTrial>& trials, const Registry& registry, const std::filesystem::path& folder, bool fresh, int threads);

}  // namespace koksma
