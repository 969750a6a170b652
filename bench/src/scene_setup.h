#pragma once
// From command-line arguments to a scene, a plan and a bound sampler.

#include "commands.h"

#include <koksma/integrators/render.h>

#include <memory>

namespace koksma {

/// Everything that render, replay and plan need, checked.
struct SceneSetup {
    Scene scene;
    RenderPlan plan;
    std::unique_ptr<SamplerFactory> sampler;
    std::uint64_t spp = 1, seed = 0;
    [[nodiscard]] std::unique_ptr<SampleSource> bind() const;
    /// A pixel's samples must be indices of the plan.
    [[nodiscard]] PixelRect rect() const { return crop_of(scene.film); }
};

/// The sampler that is used where neither the command line nor the scene names one.
inline constexpr const char* kDefaultSampler = "sobol:randomize=owen";

/// @throws UsageError for arguments without meaning, Error for what is wrong with the scene
[[nodiscard]] SceneSetup set_up(const SceneArguments& arguments, const Registry& registry);

/// A set of effects by names with commas; among them `needed`, what the scene calls for, and `all`, what the largest kernel has that could
/// render it. @throws UsageError for an unknown name
[[nodiscard]] EffectSet effects_of(const std::string& names, EffectSet needed);

/// @throws UsageError if an item is not name=value
[[nodiscard]] SceneParameters parameters_of(const std::vector<std::string>& defines);

/// The sampler, with an unknown name as wrong usage. @throws UsageError
[[nodiscard]] std::unique_ptr<SamplerFactory> make_sampler(const Registry& registry, const std::string& spec);

}  // namespace koksma
