#pragma once
// Parts of the ladders' scenes.

#include <koksma/scene/description.h>

#include <utility>

namespace koksma::ladder {

[[nodiscard]] glm::dmat4 translated(glm::dvec3 by);
[[nodiscard]] glm::dmat4 scaled(double by);
/// Turns a rectangle's normal from +z to +y, to -y.
[[nodiscard]] glm::dmat4 facing_up();
[[nodiscard]] glm::dmat4 facing_down();
/// Mitsuba's camera: looks along +z, +x is left in the image.
[[nodiscard]] glm::dmat4 look_at(glm::dvec3 origin, glm::dvec3 target);

/// Nothing but a film of so many pixels and planes that cut nothing off.
[[nodiscard]] SceneDescription empty_scene(int pixels = 1);
std::uint32_t add_material(SceneDescription& scene, OneSidedMaterial material);
Shape& add_shape(SceneDescription& scene, Geometry geometry, const glm::dmat4& to_world, std::uint32_t material);
/// A black lamp.
Shape& add_light(SceneDescription& scene, Geometry geometry, const glm::dmat4& to_world, double radiance);
/// A closed cube of that half side that shines inwards; the camera is inside.
[[nodiscard]] SceneDescription furnace(const glm::dmat4& to_world, double half, float albedo, float radiance);
/// A floor of a material in y = 0, whose origin the camera sees from that direction, a metre away.
[[nodiscard]] SceneDescription floor_seen_from(glm::dvec3 direction, OneSidedMaterial material);

}  // namespace koksma::ladder
