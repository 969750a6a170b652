#pragma once
// Light that passes straight through a surface: masks, null boundaries, thin glass. Volumetric paths cross such surfaces without a bounce.

#include <koksma/scene/bsdf/layered.h>

namespace koksma {

/// What passes straight on.
struct Passage {
    Vec3f transmittance{0.0f};  ///< of radiance
    float probability = 0.0f;   ///< that a sample of the BSDF goes straight on; positive where the transmittance is
};

/// @param wo  in the surface's shading frame
[[nodiscard]] Passage passage_at(const Scene& scene, const LayeredPoint& at, Vec3f wo) noexcept;

/// As sample_layered, of what does not pass. The density is still that among all samples.
/// @pre passage_at(...).probability < 1
[[nodiscard]] BsdfSample sample_stopped(const Scene& scene, const LayeredPoint& at, Vec3f wo, float u_lobe, Vec2f u) noexcept;

}  // namespace koksma
