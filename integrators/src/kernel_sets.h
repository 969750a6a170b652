#pragma once
// The sets of effects that kernels are compiled for.

#include <koksma/integrators/kernel.h>

namespace koksma::detail {

/// Smooth surfaces lit by surfaces.
inline constexpr EffectSet kDiffuseEffects{Effect::area_light, Effect::light_choice, Effect::diffuse, Effect::shading_normals, Effect::roulette};
inline constexpr EffectSet kDiffuseTexturedEffects =
    kDiffuseEffects | EffectSet{Effect::texture, Effect::two_sided, Effect::environment, Effect::point_light, Effect::lens};
inline constexpr EffectSet kSpecularEffects =
    kDiffuseEffects | EffectSet{Effect::analytic_shape, Effect::sphere_light, Effect::specular, Effect::dielectric, Effect::lobe, Effect::environment};

// One function a variant, one source file each, so that they compile in parallel.
std::unique_ptr<Tracer> make_reference_diffuse(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_specular(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_diffuse_textured(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_all(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_diffuse(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_specular(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_diffuse_textured(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_all(const TraceJob& job);

}  // namespace koksma::detail
