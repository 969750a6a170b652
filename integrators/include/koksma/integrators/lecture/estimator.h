#pragma once
// The choices that a lecture on path tracing compares: how light is found, how directions are drawn, how a path ends, how often it
// branches.

#include <koksma/plan/plan.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace koksma {

/// How the directions are drawn in which a path goes on.
enum class DirectionStrategy : std::uint8_t {
    bsdf,     ///< from the BSDF
    uniform,  ///< uniformly on the hemisphere at diffuse surfaces and rough conductors; from the BSDF at others, which may have delta lobes
};

/// How a path ends before it leaves the scene. The first three cut it (biased), the others play Russian roulette (unbiased).
enum class PathEnd : std::uint8_t {
    none,         ///< max_depth alone
    depth,        ///< after `end_value` vertices, counted as max_depth counts them
    threshold,    ///< where the largest component of the throughput falls below `end_value`
    constant,     ///< roulette with survival `end_value`
    reflectance,  ///< roulette with survival = reflectance of the surface: absorption is 1 - reflectance
    throughput,   ///< roulette with survival = min(1, throughput x eta^2), as the production kernels do
};
[[nodiscard]] constexpr bool plays_roulette(PathEnd end) noexcept { return end >= PathEnd::constant; }

/// Where roulette gets its number from.
enum class RouletteNumber : std::uint8_t {
    own,       ///< from a slot of its own
    rescaled,  ///< the first number of the direction decides and is stretched anew: I_roulette of the lecture. At diffuse surfaces, whose
               ///< survival is known before a direction is drawn; others play with their own number
};

struct EstimatorSettings {
    Technique light = Technique::mis;
    DirectionStrategy direction = DirectionStrategy::bsdf;
    PathEnd end = PathEnd::throughput;
    double end_value = 0.0;  ///< of depth: >= 1; threshold: > 0; constant: (0, 1]
    RouletteNumber number = RouletteNumber::own;
    /// Light samples and directions at every vertex: 1 is path tracing, more is stochastic ray tracing. Child k of the vertex with number j
    /// of its level (all samples of a pixel together) reads sample number branching * j + k of the sequence.
    std::uint32_t branching = 1;
};

[[nodiscard]] std::string_view name(Technique s) noexcept;
[[nodiscard]] std::string_view name(DirectionStrategy s) noexcept;
[[nodiscard]] std::string_view name(RouletteNumber n) noexcept;
/// "depth=4", "throughput"
[[nodiscard]] std::string text_of_end(const EstimatorSettings& settings);

/// The reverse. @throws Error naming what was found and what was expected
[[nodiscard]] Technique technique_of(std::string_view text);
[[nodiscard]] DirectionStrategy direction_strategy_of(std::string_view text);
[[nodiscard]] RouletteNumber roulette_number_of(std::string_view text);
void set_end(EstimatorSettings& settings, std::string_view text);

/// What these estimators know of. A scene that calls for more is refused.
inline constexpr EffectSet kLectureEffects{Effect::lens,           Effect::light_choice,    Effect::area_light,  Effect::sphere_light,
                                           Effect::point_light,    Effect::environment,     Effect::diffuse,     Effect::glossy,
                                           Effect::specular,       Effect::dielectric,      Effect::two_sided,   Effect::texture,
                                           Effect::analytic_shape, Effect::shading_normals, Effect::anisotropic, Effect::roulette,
                                           Effect::many_lights,    Effect::mesh_attribute,  Effect::lobe,        Effect::layered};

/// The plan of an estimator: as make_plan(scene, integrator), but roulette has slots only where it is played (from rr_depth on).
/// @throws Error for settings without meaning, paths that would never end, and scenes that the estimator cannot render
[[nodiscard]] RenderPlan make_plan(const Scene& scene, const IntegratorSettings& integrator, const EstimatorSettings& estimator);

}  // namespace koksma
