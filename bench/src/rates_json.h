#pragma once
// Rates of a sampler on the integrands, for `koksma rates` and `koksma card`.

#include <koksma/rates/rates.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace koksma {

/// The name of an integrand with its number of dimensions, as typed and printed: "addexp6".
[[nodiscard]] std::string label(const convergence::Integrand& f);

/// Rates over the good counts from 64 to `most`.
/// @param integrands  names or labels; empty: all
/// @throws UsageError if fewer than two counts are good
[[nodiscard]] std::vector<convergence::Rates> all_rates(const SamplerFactory& factory, const std::vector<std::string>& integrands, std::uint64_t most,
                                                        int replicates);

[[nodiscard]] nlohmann::ordered_json json_of(const convergence::Rates& rates);

}  // namespace koksma
