#pragma once
// One number for everything that can change the expected image.

#include <koksma/scene/description.h>

namespace koksma::loader {

/// Covers shapes with the contents of their meshes, materials with the contents of their textures, lights, camera, film size,
/// max_depth and hide_emitters. Not the crop, sampler, spp, seed, rr_depth, names, or where things were written.
[[nodiscard]] std::uint64_t scene_hash(const SceneDescription& scene);

}  // namespace koksma::loader
