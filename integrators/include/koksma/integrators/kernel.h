#pragma once
// One kernel body, compiled for a few sets of effects; the smallest one that contains what a scene calls for is run.

#include <koksma/film/film.h>
#include <koksma/integrators/draws.h>
#include <koksma/integrators/path.h>

#include <span>
#include <string>
#include <string_view>

namespace koksma {

/// A compiled variant. All admissible variants give the same bytes: the layout follows the scene, not the kernel.
struct Kernel {
    std::string_view name;  ///< "reference/diffuse"
    EffectSet effects;
    /// Traces the samples of the block that `draws` has begun. @param radiance  one value per sample
    void (*trace)(const Scene& scene, const IntegratorSettings& settings, Draws& draws, std::span<Vec3f> radiance, RayCounts& rays) noexcept;
};

/// All variants, smallest first; the last one has every effect.
[[nodiscard]] std::span<const Kernel> kernels() noexcept;

/// The first variant that contains the effects.
[[nodiscard]] const Kernel& choose_kernel(EffectSet effects) noexcept;

/// A variant by name. @throws Error naming all, or when it lacks an effect of the scene
[[nodiscard]] const Kernel& find_kernel(std::string_view name, EffectSet needed);

}  // namespace koksma
