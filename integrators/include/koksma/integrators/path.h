#pragma once
// The reference path kernel: one ray at a time, in the order in which a lecture explains it.

#include <koksma/integrators/draws.h>
#include <koksma/integrators/tracer.h>
#include <koksma/scene/light_choice.h>
#include <koksma/scene/light_sampling.h>

#include <cmath>
#include <limits>

namespace koksma {

/// Watches nothing, at no cost. An observer with the same members sees every step of a path (koksma replay).
struct NoObserver {
    void camera(const Ray&) noexcept {}
    void met(const Ray&, Hit) noexcept {}
    void shadow(const Ray&, bool) noexcept {}
    void escaped(Vec3f, Vec3f, float) noexcept {}
    void vertex(const Surface&, Hit, Vec3f, Vec3f) noexcept {}
    void passed(Vec3f) noexcept {}
    void collision(Vec3f, Vec3f, Vec3f) noexcept {}
    void emission(Vec3f, float) noexcept {}
    void direct_light(std::uint32_t, const LightSample&, Vec3f, float, bool) noexcept {}
    void bounce(const BsdfSample&, Vec3f, Vec3f) noexcept {}
    void roulette(float, float, bool) noexcept {}
};

/// After so many bounces in a row without any loss a path is played for.
inline constexpr std::int32_t kLosslessBounces = 256;

/// Weight of a sample that `own` could draw with density a and the other technique with density b.
template <EffectSet kEffects>
[[nodiscard]] float technique_weight(const IntegratorSettings& settings, Technique own, float a, float b) noexcept {
    if constexpr (kEffects.has(Effect::one_technique))
        if (settings.technique != Technique::mis) return settings.technique == own ? 1.0f : 0.0f;
    return power_heuristic(a, b);
}

/// The radiance along one camera sample: emission, next-event estimation and BSDF sampling combined by the power heuristic,
/// Russian roulette without a cap.
/// @param draws     with the path selected
/// @return          linear RGB, W sr^-1 m^-2; a NaN if a ray could not be traced (the film counts and locates it)
/// Source: Kajiya 1986, "The rendering equation"; Veach 1997, chapters 8 to 10. max_depth and rr_depth as in Mitsuba 3.
template <EffectSet kEffects, class Observer>
[[nodiscard]] Vec3f trace_path(const Scene& scene, const IntegratorSettings& settings, Draws& draws, RayCounts& rays,
                               Observer& observer) noexcept {
    constexpr Vec3f kInvalid{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::quiet_NaN()};
    constexpr bool kSmooth = kEffects.has(Effect::diffuse) || kEffects.has(Effect::glossy);
    constexpr bool kExtendedLights = kEffects.has(Effect::area_light) || kEffects.has(Effect::environment);
    constexpr bool kDelta = kEffects.has(Effect::specular) || kEffects.has(Effect::dielectric);

    Vec3f radiance{0.0f};
    Vec3f beta{1.0f};            // f |cos| / pdf of the path so far
    float eta_scale = 1.0f;      // square of the index that the path is in: what beta lost by compression, for roulette
    float pdf_bsdf = 0.0f;       // of the last direction, per steradian
    bool last_was_delta = true;  // light sampling could not have made the last direction
    Vec3f last_p{0.0f};
    [[maybe_unused]] Vec3f last_n{0.0f, 0.0f, 1.0f};  // at last_p, as lights were chosen there
    [[maybe_unused]] std::int32_t lossless = 0;       // bounces in a row after which nothing was lost

    Vec2f u_lens;
    if constexpr (kEffects.has(Effect::lens)) u_lens = draws.lens();
    const Pixel pixel = draws.id().pixel;
    const auto from_camera = camera_ray<float>(scene.camera, film_point(scene.camera, pixel.x, pixel.y, draws.film()), u_lens);
    Ray ray{from_camera.o, from_camera.d, from_camera.t_near, from_camera.t_far};
    float time = 0.0f;
    if constexpr (kEffects.has(Effect::motion)) ray.time = time = draws.time();
    observer.camera(ray);
    if (settings.max_depth == 0) return radiance;

    const auto light_probability = [&](std::uint32_t light, std::uint32_t triangle = kWholeLight) {
        return choice_probability<kEffects>(scene, light, triangle, last_p, last_n);
    };

    for (std::int32_t depth = 0;; ++depth) {
        // ---- where the ray goes
        if (!is_traceable(ray.o, ray.d)) return kInvalid;
        ++rays.closest;
        const Hit hit = closest_hit<kEffects>(scene, ray);
        observer.met(ray, hit);
        if (!hit.valid()) {
            if constexpr (kEffects.has(Effect::environment)) {
                if (scene.environment_light >= 0 && !(depth == 0 && settings.hide_emitters)) {
                    const EnvironmentValue sky = environment_value(scene, ray.d);
                    float weight = 1.0f;
                    if (!last_was_delta)
                        weight =
                            technique_weight<kEffects>(settings, Technique::bsdf, pdf_bsdf,
                                                       sky.pdf_w * light_probability(static_cast<std::uint32_t>(scene.environment_light)));
                    radiance += beta * sky.radiance * weight;
                    observer.escaped(ray.d, beta * sky.radiance * weight, weight);
                }
            }
            break;
        }
        const Surface surface = surface_at<kEffects>(scene, ray, hit);
        const Vec3f wo = -ray.d;
        observer.vertex(surface, hit, wo, beta);

        // ---- light that the surface itself sends out
        if constexpr (kEffects.has(Effect::area_light)) {
            const Vec3f le = emitted<kEffects>(scene, surface, wo);
            if (max_component(le) > 0.0f && !(depth == 0 && settings.hide_emitters)) {
                float weight = 1.0f;
                if (!last_was_delta) {
                    const auto index = static_cast<std::uint32_t>(scene.geometries[surface.geometry].light);
                    const std::uint32_t triangle = chosen_triangle<kEffects>(scene, index, hit.primitive);
                    weight = technique_weight<kEffects>(settings, Technique::bsdf, pdf_bsdf,
                                                        light_pdf<kEffects>(scene, scene.lights[index], last_p, surface, ray.d, triangle) *
                                                            light_probability(index, triangle));
                }
                radiance += beta * le * weight;
                observer.emission(beta * le * weight, weight);
            }
        }
        if (settings.max_depth >= 0 && depth + 1 >= settings.max_depth) break;

        const LocalBsdf local = bsdf_at<kEffects>(scene, surface, wo);
        const Vec3f wo_local = local.frame.to_local(wo);
        const auto bounce = static_cast<std::size_t>(depth);

        // ---- light that arrives straight from a light source
        if constexpr (kSmooth) {
            if (has_smooth_lobe(local.bsdf) && scene.light_choice.total() > 0.0) {
                LightChoice choice;
                if constexpr (kEffects.has(Effect::light_choice))
                    choice = choose_light<kEffects>(scene, surface.p, lit_normal_of<kEffects>(local, wo_local), draws.light_choice(bounce));
                Vec2f u_light;
                if constexpr (kExtendedLights) u_light = draws.light_position(bounce);
                const LightSample light = sample_light<kEffects>(scene, scene.lights[choice.light], surface.p, u_light, choice.triangle);
                if (light.pdf_w > 0.0f && choice.probability > 0.0f) {
                    const BsdfValue value = eval_local<kEffects>(scene, local, wo_local, local.frame.to_local(light.wi));
                    const float pdf_light = light.pdf_w * choice.probability;
                    const float weight =
                        light.delta ? 1.0f : technique_weight<kEffects>(settings, Technique::light, pdf_light, value.pdf_w);
                    const Vec3f contribution = beta * value.f_cos * light.radiance * (weight / pdf_light);
                    if (!(sum(contribution) <= 0.0f)) {  // a NaN goes on, to be counted
                        Ray shadow;
                        shadow.o = offset_origin(surface.p, surface.p_error, surface.ng, light.wi);
                        shadow.d = light.at_infinity ? light.wi : light.target - shadow.o;
                        shadow.t_far = light.at_infinity ? kInfinity : 1.0f;
                        shadow.time = time;
                        if (!is_traceable(shadow.o, shadow.d)) return kInvalid;
                        ++rays.shadow;
                        const bool visible = !scene.accelerator.occluded(shadow);
                        observer.shadow(shadow, visible);
                        if (visible) radiance += contribution;
                        observer.direct_light(choice.light, light, contribution, weight, visible);
                    }
                }
            }
        }

        // ---- where the path goes on
        float u_lobe = 0.0f;
        if constexpr (kEffects.has(Effect::lobe))
            if (chooses_lobe(local.bsdf)) u_lobe = draws.lobe(bounce);
        Vec2f u_direction;
        if constexpr (kSmooth)
            if (has_smooth_lobe(local.bsdf)) u_direction = draws.direction(bounce);
        const BsdfSample next = sample_local<kEffects>(scene, local, wo_local, u_lobe, u_direction);
        if (next.pdf_w <= 0.0f) break;
        beta *= next.weight;
        if (!(sum(beta) > 0.0f) || !(next.pdf_w > 0.0f)) {
            if (sum(beta) <= 0.0f) break;
            return kInvalid;  // not a number: to be counted, not to end in silence
        }
        if constexpr (kEffects.has(Effect::dielectric)) eta_scale *= next.eta * next.eta;
        const Vec3f wi = local.frame.to_world(next.wi);
        observer.bounce(next, wi, beta);
        pdf_bsdf = next.pdf_w;
        if constexpr (kDelta)
            last_was_delta = next.delta;
        else
            last_was_delta = false;
        last_p = surface.p;
        if constexpr (kEffects.has(Effect::many_lights)) last_n = lit_normal_of<kEffects>(local, wo_local);
        ray = Ray{.o = offset_origin(surface.p, surface.p_error, surface.ng, wi), .d = wi, .time = time};

        // ---- Russian roulette: survival is never capped below one (a cap q gives infinite variance once albedo^2 >= q), except
        //      for a path that has lost nothing for long: trapped in glass by total reflection, it would go on for ever
        if constexpr (kEffects.has(Effect::roulette)) {
            if (depth + 1 >= settings.rr_depth) {
                float survival = max_component(beta) * eta_scale;
                lossless = survival < 1.0f ? 0 : lossless + 1;
                if (lossless > kLosslessBounces) survival = 0.9f;
                if (survival < 1.0f) {
                    const float u = draws.roulette(bounce);
                    observer.roulette(u, survival, u < survival);
                    if (!(u < survival)) break;
                    beta *= 1.0f / survival;
                }
            }
        }
    }
    return radiance;
}

}  // namespace koksma
