#pragma once
// Instantiates the reference kernel for one set of effects. Each kernel_*.cpp holds one, so that they compile in parallel.

#include <koksma/integrators/kernel.h>

namespace koksma::detail {

template <EffectSet kEffects>
void trace_block(const Scene& scene, const IntegratorSettings& settings, Draws& draws, std::span<Vec3f> radiance, RayCounts& rays) noexcept {
    NoObserver nobody;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        draws.select(i);
        radiance[i] = trace_path<kEffects>(scene, settings, draws, rays, nobody);
    }
}

inline constexpr EffectSet kDiffuseEffects{Effect::area_light, Effect::light_choice, Effect::diffuse, Effect::shading_normals, Effect::roulette};
inline constexpr EffectSet kDiffuseTexturedEffects = kDiffuseEffects | EffectSet{Effect::texture, Effect::two_sided, Effect::environment,
                                                                                 Effect::point_light, Effect::shading_normals, Effect::lens};
inline constexpr EffectSet kSpecularEffects = kDiffuseEffects | EffectSet{Effect::analytic_shape, Effect::sphere_light, Effect::specular,
                                                                          Effect::dielectric, Effect::shading_normals};

extern template void trace_block<kDiffuseEffects>(const Scene&, const IntegratorSettings&, Draws&, std::span<Vec3f>, RayCounts&) noexcept;
extern template void trace_block<kDiffuseTexturedEffects>(const Scene&, const IntegratorSettings&, Draws&, std::span<Vec3f>, RayCounts&) noexcept;
extern template void trace_block<kSpecularEffects>(const Scene&, const IntegratorSettings&, Draws&, std::span<Vec3f>, RayCounts&) noexcept;
extern template void trace_block<EffectSet::all()>(const Scene&, const IntegratorSettings&, Draws&, std::span<Vec3f>, RayCounts&) noexcept;

}  // namespace koksma::detail
