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

/// Stops what stands still while the shutter is open; of every other shape that moves makes a group with an instance.
/// @return  placements of every instance, one or, at equal distances in time, several
[[nodiscard]] std::vector<std::vector<glm::dmat4>> settle(SceneDescription& description);

/// Fills geometry arrays, one GeometryRecord per shape: of shapes relative to the camera, then of groups relative to their middle;
/// and bounding_radius of those that are no group's. No BVH yet.
/// @param origin  world position of the camera
void compile_shapes(Scene& scene, glm::dvec3 origin);

/// Fills instances and placements; bounding_radius takes them in. Needs the geometry.
/// @param placements  what settle() gave
void compile_instances(Scene& scene, const std::vector<std::vector<glm::dmat4>>& placements, glm::dvec3 origin);

/// Radius of a ball about the origin around some of the geometry, which is all at the end of the arrays.
/// @param first  how many positions, spheres, disks and cylinders are before it
struct GeometryCounts {
    std::size_t positions = 0, spheres = 0, disks = 0, cylinders = 0;
};
[[nodiscard]] double radius_from(const Scene& scene, GeometryCounts first);

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
