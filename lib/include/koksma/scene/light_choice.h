#pragma once
// Which light to sample: one question for the choice by power and for the tree. Kernels without the effect know no tree; those that
// have it ask the tree of scenes that have one.

#include <koksma/scene/scene.h>

namespace koksma {

/// Chooses a light to sample: by power, or where there are many, for a point with normal n on the side that reflects.
template <EffectSet kEffects>
[[nodiscard]] LightChoice choose_light(const Scene& scene, Vec3f p, Vec3f n, float u) noexcept {
    if constexpr (kEffects.has(Effect::many_lights))
        if (!scene.light_tree.empty()) return scene.light_tree.choose(p, n, u);
    const DiscreteSample choice = scene.light_choice.sample(u);
    return {choice.index, kWholeLight, choice.probability, choice.u};
}

/// @return  the probability with which choose_light takes this light (and triangle, as chosen_triangle names it)
template <EffectSet kEffects>
[[nodiscard]] float choice_probability(const Scene& scene, std::uint32_t light, std::uint32_t triangle, Vec3f p, Vec3f n) noexcept {
    if constexpr (kEffects.has(Effect::many_lights))
        if (!scene.light_tree.empty()) return scene.light_tree.probability(light, triangle, p, n);
    if constexpr (kEffects.has(Effect::light_choice)) return scene.light_choice.probability(light);
    return 1.0f;
}

/// @return  what choose_light calls this primitive of a light: itself where the light is chosen by triangle, else kWholeLight
template <EffectSet kEffects>
[[nodiscard]] std::uint32_t chosen_triangle(const Scene& scene, std::uint32_t light, std::uint32_t primitive) noexcept {
    if constexpr (kEffects.has(Effect::many_lights))
        if (!scene.light_tree.empty() && scene.lights[light].kind == LightKind::mesh) return primitive;
    return kWholeLight;
}

}  // namespace koksma
