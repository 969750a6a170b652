#pragma once
// The reference kernel for scenes with media, and with surfaces that let light pass straight on. In scenes with neither it makes the
// paths of trace_path, bit for bit; read that one first.

#include <koksma/integrators/path.h>
#include <koksma/integrators/volume_light.h>
#include <koksma/scene/medium/phase.h>

namespace koksma {

/// The radiance along one camera sample. Between two vertices a path flies through media, and through surfaces that let it pass, which
/// count as no bounce. Emission and next-event estimation meet under the power heuristic; densities of flights are means over colour
/// channels (tracking.h), so both techniques carry them, and the weight of one without flights is that of surfaces alone.
/// @param draws  with the path selected
/// @return       as trace_path
/// Source: Miller, Georgiev and Jarosz 2019, "A null-scattering path integral formulation of light transport". max_depth, rr_depth and what
/// counts as a bounce as in Mitsuba 3's volpath.
template <EffectSet kEffects, class Observer>
[[nodiscard]] Vec3f trace_volume_path(const Scene& scene, const RenderPlan& plan, Draws& draws, RayCounts& rays,
                                      Observer& observer) noexcept {
    constexpr Vec3f kInvalid{std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::quiet_NaN()};
    const IntegratorSettings& settings = plan.integrator;
    // A set of effects may be larger than what the scene calls for.
    const bool crosses = settings.volumetric && plan.effects.has(Effect::null_boundary);
    const bool has_media = settings.volumetric && plan.effects.has(Effect::medium);
    const auto bounces_left = [&](std::int32_t depth) { return settings.max_depth < 0 || depth + 1 < settings.max_depth; };

    Vec3f radiance{0.0f};
    PathWeight weight;
    float eta_scale = 1.0f;                        // square of the index that the path is in: what beta lost by compression, for roulette
    float pdf_direction = 0.0f;                    // of the last direction, per steradian
    bool last_was_delta = true;                    // light sampling could not have made the last direction
    Vec3f last_p{0.0f}, last_n{0.0f, 0.0f, 1.0f};  // where lights were last chosen
    std::int32_t lossless = 0;
    std::int32_t medium = has_media ? scene.camera_medium : -1;
    ShadowWalk<kEffects> shadows(scene, crosses, draws, rays);

    const Pixel pixel = draws.id().pixel;
    const auto from_camera = camera_ray<float>(scene.camera, film_point(scene.camera, pixel.x, pixel.y, draws.film()), draws.lens());
    Ray ray{from_camera.o, from_camera.d, from_camera.t_near, from_camera.t_far};
    if constexpr (kEffects.has(Effect::motion)) ray.time = draws.time();
    observer.camera(ray);
    if (settings.max_depth == 0) return radiance;

    const auto light_probability = [&](std::uint32_t light, std::uint32_t triangle = kWholeLight) {
        return choice_probability<kEffects>(scene, light, triangle, last_p, last_n);
    };
    const auto behind = [&](const Surface& s, Vec3f w) {
        return has_media ? medium_behind(scene, s, w, medium) : -1;
    };

    for (std::int32_t depth = 0;; ++depth) {
        const auto bounce = static_cast<std::size_t>(depth);

        // ---- the way to the next vertex, which is a collision in a medium or a surface
        WayNumbers u;
        if (plan.effects.has(Effect::medium)) u.survival = 1.0f - draws.distance(bounce);
        if (plan.effects.has(Effect::heterogeneous)) u.collision = draws.collision(bounce);
        if (plan.effects.has(Effect::mask)) u.passage = draws.passage(bounce);
        std::uint32_t step = 0;
        const auto next_distance = [&] { return draws.tail(bounce, SlotRole::distance, ++step); };
        Collision collision;
        Surface surface;
        LocalBsdf local;
        Vec3f wo, wo_local;
        float stopped = 1.0f;  // probability that the surface did not let the path pass
        for (;;) {
            if (!is_traceable(ray.o, ray.d)) return kInvalid;
            ++rays.closest;
            const Hit hit = closest_hit<kEffects>(scene, ray);
            observer.met(ray, hit);
            if (hit.valid()) surface = surface_at<kEffects>(scene, ray, hit);
            if (medium >= 0) {
                const MediumRecord& m = scene.media[static_cast<std::size_t>(medium)];
                const float far = hit.valid() ? distance_along(ray, surface) : ray.t_far;
                collision = m.heterogeneous ? fly_heterogeneous(m, ray.o, ray.d, ray.t_near, far, weight, u, next_distance)
                                            : fly_homogeneous(m, ray.o, ray.d, ray.t_near, far, weight, u);
                if (collision.happened) break;
            }
            if (!hit.valid()) {
                if (scene.environment_light >= 0 && !(depth == 0 && settings.hide_emitters)) {
                    const EnvironmentValue sky = environment_value(scene, ray.d);
                    float mis = 1.0f;
                    if (!last_was_delta)
                        mis = technique_weight<kEffects>(
                            settings, Technique::bsdf, pdf_direction * weight.way,
                            sky.pdf_w * light_probability(static_cast<std::uint32_t>(scene.environment_light)));
                    radiance += weight.beta * sky.radiance * mis;
                    observer.escaped(ray.d, weight.beta * sky.radiance * mis, mis);
                }
                return radiance;
            }
            wo = -ray.d;
            observer.vertex(surface, hit, wo, weight.beta);

            // light that the surface itself sends out
            const Vec3f le = emitted<kEffects>(scene, surface, wo);
            if (max_component(le) > 0.0f && !(depth == 0 && settings.hide_emitters)) {
                float mis = 1.0f;
                if (!last_was_delta) {
                    const auto index = static_cast<std::uint32_t>(scene.geometries[surface.geometry].light);
                    const std::uint32_t triangle = chosen_triangle<kEffects>(scene, index, hit.primitive);
                    mis = technique_weight<kEffects>(settings, Technique::bsdf, pdf_direction * weight.way,
                                                     light_pdf<kEffects>(scene, scene.lights[index], last_p, surface, ray.d, triangle) *
                                                         light_probability(index, triangle));
                }
                radiance += weight.beta * le * mis;
                observer.emission(weight.beta * le * mis, mis);
            }
            if (!crosses && !bounces_left(depth)) return radiance;

            local = bsdf_at<kEffects>(scene, surface, wo);
            wo_local = local.frame.to_local(wo);
            if (!crosses) break;
            const Passage passage = passage_at(scene, local.layered, wo_local);
            if (!(u.passage < passage.probability)) {
                stopped = 1.0f - passage.probability;
                break;
            }
            u.passage /= passage.probability;
            u.passage = u.passage < kOneMinusUlp ? u.passage : kOneMinusUlp;
            weight.beta *= passage.transmittance * (1.0f / passage.probability);
            if (!(max_component(weight.beta) > 0.0f)) return radiance;
            weight.way *= passage.probability;
            medium = behind(surface, ray.d);
            ray.o = offset_origin(surface.p, surface.p_error, surface.ng, ray.d);
            ray.t_near = 0.0f;
            ray.t_far = kInfinity;
            observer.passed(weight.beta);
        }
        if (!bounces_left(depth)) return radiance;
        const Vec3f p = collision.happened ? collision.p : surface.p;
        const MediumRecord* scatterer = collision.happened ? &scene.media[static_cast<std::size_t>(medium)] : nullptr;
        if (scatterer) {
            wo = -ray.d;
            observer.collision(p, wo, weight.beta);
            if (!(max_component(weight.beta) > 0.0f)) return radiance;
        }
        // What a surface does is done to what it stopped; its densities are those among all samples.
        const Vec3f beta_stopped = stopped < 1.0f ? weight.beta * (1.0f / stopped) : weight.beta;
        const Vec3f lit_n = scatterer ? Vec3f{0.0f} : lit_normal_of<kEffects>(local, wo_local);

        // ---- light that arrives straight from a light source
        if (scatterer ? scatterer->sample_emitters : has_smooth_lobe(local.bsdf)) {
            if (scene.light_choice.total() > 0.0) {
                const LightChoice choice = choose_light<kEffects>(scene, p, lit_n, draws.light_choice(bounce));
                const LightSample light =
                    sample_light<kEffects>(scene, scene.lights[choice.light], p, draws.light_position(bounce), choice.triangle);
                if (light.pdf_w > 0.0f && choice.probability > 0.0f) {
                    BsdfValue value;
                    if (scatterer) {
                        value.pdf_w = eval_phase(scatterer->g, dot(wo, light.wi));
                        value.f_cos = Vec3f(value.pdf_w);
                    } else {
                        value = eval_local<kEffects>(scene, local, wo_local, local.frame.to_local(light.wi));
                        if (stopped < 1.0f) value.pdf_w /= stopped;
                    }
                    const float pdf_light = light.pdf_w * choice.probability;
                    float mis = light.delta ? 1.0f : technique_weight<kEffects>(settings, Technique::light, pdf_light, value.pdf_w);
                    Vec3f contribution = beta_stopped * value.f_cos * light.radiance * (mis / pdf_light);
                    if (!(sum(contribution) <= 0.0f)) {  // a NaN goes on, to be counted
                        Ray shadow = ray;
                        shadow.t_near = 0.0f;
                        shadow.o = scatterer ? p : offset_origin(surface.p, surface.p_error, surface.ng, light.wi);
                        shadow.d = light.at_infinity ? light.wi : light.target - shadow.o;
                        shadow.t_far = light.at_infinity ? kInfinity : 1.0f;
                        if (!is_traceable(shadow.o, shadow.d)) return kInvalid;
                        const Reached reached = shadows.reach(shadow, !light.at_infinity, scatterer ? medium : behind(surface, light.wi),
                                                              weight, bounce, observer);
                        const bool visible = !(sum(reached.transmittance) <= 0.0f);
                        if (visible && reached.way != 1.0f) {
                            // The other technique would have had to come through, too.
                            mis = light.delta
                                      ? 1.0f
                                      : technique_weight<kEffects>(settings, Technique::light, pdf_light, value.pdf_w * reached.way);
                            contribution = beta_stopped * value.f_cos * light.radiance * (mis / pdf_light);
                        }
                        if (visible) {
                            contribution *= reached.transmittance;
                            radiance += contribution;
                        }
                        observer.direct_light(choice.light, light, contribution, mis, visible);
                    }
                }
            }
        }

        // ---- where the path goes on
        BsdfSample next;
        if (scatterer) {
            next.wi = sample_phase(scatterer->g, wo, draws.direction(bounce));
            next.weight = Vec3f(1.0f);
            next.pdf_w = eval_phase(scatterer->g, dot(wo, next.wi));
            next.eta = 1.0f;
            last_was_delta = !scatterer->sample_emitters;
        } else {
            const float u_lobe = chooses_lobe(local.bsdf) ? draws.lobe(bounce) : 0.0f;
            const Vec2f u_direction = has_smooth_lobe(local.bsdf) ? draws.direction(bounce) : Vec2f{};
            if (crosses && stopped < 1.0f) {
                next = sample_stopped(scene, local.layered, wo_local, u_lobe, u_direction);
                next.pdf_w /= stopped;
            } else {
                next = sample_local<kEffects>(scene, local, wo_local, u_lobe, u_direction);
            }
            last_was_delta = next.delta;
        }
        if (next.pdf_w <= 0.0f) break;
        weight.beta *= next.weight;
        if (!(sum(weight.beta) > 0.0f) || !(next.pdf_w > 0.0f)) {
            if (sum(weight.beta) <= 0.0f) break;
            return kInvalid;  // not a number: to be counted, not to end in silence
        }
        eta_scale *= next.eta * next.eta;
        const Vec3f wi = scatterer ? next.wi : local.frame.to_world(next.wi);
        observer.bounce(next, wi, weight.beta);
        pdf_direction = next.pdf_w;
        last_p = p;
        last_n = lit_n;
        weight.way = 1.0f;
        if (!scatterer) medium = behind(surface, wi);
        ray.o = scatterer ? p : offset_origin(surface.p, surface.p_error, surface.ng, wi);
        ray.d = wi;
        ray.t_near = 0.0f;
        ray.t_far = kInfinity;

        // ---- Russian roulette, as on surfaces
        if (plan.effects.has(Effect::roulette) && depth + 1 >= settings.rr_depth) {
            float survival = max_component(weight.beta) * eta_scale;
            lossless = survival < 1.0f ? 0 : lossless + 1;
            if (lossless > kLosslessBounces) survival = 0.9f;
            if (survival < 1.0f) {
                const float u_roulette = draws.roulette(bounce);
                observer.roulette(u_roulette, survival, u_roulette < survival);
                if (!(u_roulette < survival)) break;
                weight.beta *= 1.0f / survival;
            }
        }
    }
    return radiance;
}

}  // namespace koksma
