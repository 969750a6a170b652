#pragma once
// Estimators and their ledgers as JSON.

#include <koksma/integrators/lecture/estimator.h>
#include <koksma/integrators/lecture/ledger.h>

#include <nlohmann/json_fwd.hpp>

namespace koksma {

[[nodiscard]] nlohmann::ordered_json json_of(const EstimatorSettings& settings);

/// Sums of weights come as means over camera samples.
[[nodiscard]] nlohmann::ordered_json json_of(const Ledger& ledger);

}  // namespace koksma
