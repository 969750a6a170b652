#pragma once
// The steps of compile(), in the order in which they run.

#include <koksma/scene/scene.h>

namespace koksma::detail {

/// Keeps who called first for the effects that are added while it lives.
class Caller {
public:
    Caller(Scene& scene, const SourceLocation& where) : scene_(scene), where_(where), before_(scene.effects) {}
    ~Caller() { scene_.call_for(EffectSet(scene_.effects.bits & ~before_.bits), where_); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

private:
    Scene& scene_;
    const SourceLocation& where_;
    EffectSet before_;
};

/// Fills sides and materials; adds the effects of the materials that shapes use.
void compile_materials(Scene& scene);

/// Fills geometry arrays, one GeometryRecord per shape, relative to the camera; no BVH yet.
/// @param origin  world position of the camera
void compile_shapes(Scene& scene, glm::dvec3 origin);

/// Fills media and the references to them. Needs the geometry's records.
void compile_media(Scene& scene, glm::dvec3 origin);

/// Fills lights, their choice by power, and the environment. Needs the geometry.
void compile_lights(Scene& scene, glm::dvec3 origin);

/// What a tree over the lights could choose: all but the environment, mesh lights by triangle.
/// @param radiances  by light: mean luminance of radiance or intensity
[[nodiscard]] std::vector<LightLeaf> light_leaves(const Scene& scene, std::span<const double> radiances);

/// A constant stays a constant; anything else becomes an entry of Scene::textures.
[[nodiscard]] TextureRef texture_ref(Scene& scene, const Texture& texture);

}  // namespace koksma::detail
