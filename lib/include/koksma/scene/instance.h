#pragma once
// Groups seen through instances: what was met, and the way between the group's own space and the scene's.

#include <koksma/scene/scene.h>

#include <cmath>

namespace koksma {

/// What a ray meets first.
template <EffectSet kEffects>
[[nodiscard]] Hit closest_hit(const Scene& scene, const Ray& ray) noexcept {
    Hit hit = scene.accelerator.intersect(ray);
    if constexpr (kEffects.has(Effect::instancing))
        if (hit.instance != Hit::kNone) {
            hit.instance -= scene.first_instance;
            hit.geometry += scene.instances[hit.instance].first_geometry;
        }
    return hit;
}

/// Both ways between a group's own space and the scene's.
struct Transfer {
    Placement to_scene, to_own;
};

/// @param time  [0, 1): between the placements of what moves, entries are interpolated linearly, as Embree does
template <EffectSet kEffects>
[[nodiscard]] Transfer transfer_at(const Scene& scene, const InstanceRecord& instance, float time) noexcept {
    const Placement* placements = &scene.placements[instance.first_placement];
    if constexpr (kEffects.has(Effect::motion))
        if (instance.placement_count > 1) {
            const std::uint32_t pieces = instance.placement_count - 1;
            const float scaled = time * static_cast<float>(pieces);
            const float whole = std::floor(scaled);
            const std::uint32_t piece = whole < static_cast<float>(pieces) ? static_cast<std::uint32_t>(whole) : pieces - 1;
            const Placement now = between(placements[piece], placements[piece + 1], static_cast<double>(scaled) - piece);
            return {now, inverse(now)};
        }
    return {placements[0], instance.to_own};
}

}  // namespace koksma
