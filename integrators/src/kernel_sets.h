#pragma once
// The sets of effects that kernels are compiled for.

#include <koksma/integrators/kernel.h>

namespace koksma::detail {

/// Smooth surfaces lit by surfaces.
inline constexpr EffectSet kDiffuseEffects{Effect::area_light, Effect::light_choice, Effect::diffuse, Effect::shading_normals,
                                           Effect::roulette};
inline constexpr EffectSet kDiffuseTexturedEffects =
    kDiffuseEffects | EffectSet{Effect::texture, Effect::two_sided, Effect::environment, Effect::point_light, Effect::lens};
inline constexpr EffectSet kSpecularEffects =
    kDiffuseEffects |
    EffectSet{Effect::analytic_shape, Effect::sphere_light, Effect::specular, Effect::dielectric, Effect::lobe, Effect::environment};

/// Paths that are bounces on surfaces and nothing else.
inline constexpr EffectSet kSurfaceEffects =
    EffectSet::all().without(Effect::medium).without(Effect::heterogeneous).without(Effect::null_boundary).without(Effect::mask);
/// The batch kernel always combines techniques.
inline constexpr EffectSet kBatchAllEffects = kSurfaceEffects.without(Effect::one_technique);

/// All but what moves or is seen through instances, whose code is in the way of every hit.
inline constexpr EffectSet kStillEffects = kBatchAllEffects.without(Effect::instancing).without(Effect::motion);

// One function a variant, one source file each, so that they compile in parallel.
std::unique_ptr<Tracer> make_reference_diffuse(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_specular(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_diffuse_textured(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_still(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_surfaces(const TraceJob& job);
std::unique_ptr<Tracer> make_reference_all(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_diffuse(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_specular(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_diffuse_textured(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_still(const TraceJob& job);
std::unique_ptr<Tracer> make_batch_all(const TraceJob& job);

}  // namespace koksma::detail
