#pragma once
// What an experiment says beforehand of a scene, so that its intervals can hold or refute it.

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace koksma {

/// One claim. In an experiment's scene, under "predictions":
///   {"slope": [null, -1.3], "samplers": ["sobol:randomize=owen"]}             the slope lies in the range; null: no bound
///   {"gain": [1000, null], "spp": 256, "samplers": ["sobol:randomize=owen"]}  MSE of random over that of the sampler
///   {"order": ["sobol:randomize=owen", "stratified"], "spp": 64}              each has less MSE than the next
struct Prediction {
    enum class Of : std::uint8_t { slope, gain, order };
    Of of = Of::slope;
    std::vector<std::string> samplers;  ///< empty, of a slope or a gain: all of the experiment (of a gain, but random)
    std::uint64_t spp = 0;              ///< of a gain or an order
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

/// @throws Error naming `where`, the key and what was expected
[[nodiscard]] Prediction prediction_of(const nlohmann::json& json, const std::string& where);

/// The predictions of a scene as a header holds them.
/// @param full_name  of a sampler as it is asked for: with all its options
[[nodiscard]] nlohmann::ordered_json predictions_json(const std::vector<Prediction>& predictions,
                                                      const std::function<std::string(const std::string&)>& full_name);

}  // namespace koksma
