#pragma once
// What a sampler says of itself, as JSON: `koksma samplers` and `koksma card`.

#include <koksma/sampling/sampler.h>

#include <nlohmann/json_fwd.hpp>

namespace koksma {

[[nodiscard]] nlohmann::ordered_json json_of(const SamplerInfo& info);

}  // namespace koksma
