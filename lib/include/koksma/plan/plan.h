#pragma once
// What a render will do, decided before the first ray: effects, slots, where each role's numbers lie.

#include <koksma/plan/effect.h>
#include <koksma/sampling/layout.h>
#include <koksma/scene/scene.h>

#include <cstdint>
#include <vector>

namespace koksma {

/// Offsets of each role's first number within the run of one bounce; -1: the plan has no such slot there.
struct BounceSlots {
    std::int16_t light_choice = -1, light_position = -1, lobe = -1, direction = -1, roulette = -1, distance = -1, collision = -1, passage = -1;
};

/// Everything that the kernels need to know besides the scene. Plain data.
struct RenderPlan {
    EffectSet effects;               ///< of the scene under these settings, or more; decides layout and kernel
    IntegratorSettings integrator;
    DimensionLayout layout;
    std::int16_t lens = -1, time = -1;  ///< offsets in the camera's run; film is at 0
    std::vector<BounceSlots> bounces;
};

/// Bounces that get slots of their own when the path length has no limit (or a larger one); later ones draw from the tail.
inline constexpr std::int32_t kMaxLaidOutBounces = 64;

/// The slots that a path needs: one table for the scene, whatever kernel runs.
[[nodiscard]] DimensionLayout make_layout(EffectSet effects, const IntegratorSettings& settings);

/// What a scene calls for under these settings.
/// @throws Error for settings without meaning (max_depth < -1, rr_depth < 0)
[[nodiscard]] EffectSet needed_effects(const Scene& scene, const IntegratorSettings& settings);

/// A plan for what is needed.
/// @throws Error for settings without meaning
[[nodiscard]] RenderPlan make_plan(const Scene& scene, const IntegratorSettings& settings);
/// A plan with the layout and kernel of a larger set, to measure what effects cost that nothing calls for.
/// @throws Error also naming the effects that are needed and missing
[[nodiscard]] RenderPlan make_plan(const Scene& scene, const IntegratorSettings& settings, EffectSet forced);

}  // namespace koksma
