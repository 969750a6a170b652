#pragma once
// Materials of several lobes or of other materials: plastics, rough glass, blends, masks, ... They are computed for one path at a time, out of
// parts (layered_parts.h) of which a kernel knows nothing. A part looks its textures up when it is asked.

#include <koksma/scene/bsdf/bsdf.h>
#include <koksma/scene/ray.h>
#include <koksma/scene/surface_uv.h>

namespace koksma {

struct Scene;
struct LayeredParts;

/// Where a layered material is asked.
struct LayeredPoint {
    std::uint32_t side = 0;  ///< index into Scene::sides
    SurfaceUv uv;
    Vec3f n{0.0f, 0.0f, 1.0f};  ///< shading normal, with geometry and primitive for what bends it
    std::uint32_t geometry = 0, primitive = 0;
    std::uint32_t instance = Hit::kNone;
    float time = 0.0f;  ///< of the ray, where there is an instance
};

/// f |cos| and density of all smooth lobes. Directions in the surface's shading frame.
[[nodiscard]] BsdfValue eval_layered(const Scene& scene, const LayeredPoint& at, Vec3f wo, Vec3f wi) noexcept;

/// @param u_lobe  one number for all choices on the way to a lobe, stretched anew by each
/// @return        a delta direction, or one of the smooth lobes with the density and weight of all of them
[[nodiscard]] BsdfSample sample_layered(const Scene& scene, const LayeredPoint& at, Vec3f wo, float u_lobe, Vec2f u) noexcept;

}  // namespace koksma
