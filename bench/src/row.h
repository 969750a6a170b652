#pragma once
// One line of results.jsonl: one render, measured.

#include "judge.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace koksma {

/// Bumped when rows of an older program cannot stand beside new ones.
inline constexpr int kRowFormat = 2;

struct Row {
    std::string scene, scene_hash, sampler;
    std::uint32_t sampler_version = 0;
    bool randomized = true;
    std::uint64_t spp = 0, seed = 0;
    int replicate = 0;
    int layout = 0;               ///< 0: the plan's; else which permuted one
    std::uint64_t prefix_of = 0;  ///< not 0: the first spp samples of a progressive render of so many
    int film[2] = {}, crop[4] = {};
    int max_depth = 0, rr_depth = 0;
    std::vector<std::string> effects;
    std::uint32_t dimensions = 0;
    std::string kernel;
    Errors all, masked;         ///< over the crop, and without directly visible emitters
    double mean_rgb[3] = {};
    double wall_seconds = 0, cpu_seconds = 0, sampler_seconds = 0;
    std::uint64_t paths = 0, rays = 0, invalid_samples = 0;
    int threads = 0;
    std::string fill;           ///< how the sampler filled its numbers: "scalar", "vector", or "unstated"
    int estimator_version = 0;
    std::string reference;      ///< digest of the reference that it was compared with
    std::string reference_content;  ///< hash of its pixels: the key does not say with how many samples it was made
    std::string commit, machine, isa;
};

void to_json(nlohmann::ordered_json& json, const Row& row);
void from_json(const nlohmann::ordered_json& json, Row& row);

}  // namespace koksma
