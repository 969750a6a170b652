#pragma once
// Groups seen through instances: what was met, and the way between the group's own space and the scene's.

#include <koksma/scene/scene.h>

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
[[nodiscard]] Transfer transfer_at(const Scene& scene, const InstanceRecord& instance, float time) noexcept;

}  // namespace koksma
