#pragma once
// Light that comes straight from a light source to a point, through media and through surfaces that let it pass.

#include <koksma/integrators/draws.h>
#include <koksma/integrators/tracer.h>
#include <koksma/scene/bsdf/passage.h>
#include <koksma/scene/light_sampling.h>
#include <koksma/scene/medium/tracking.h>

#include <limits>

namespace koksma {

/// The medium on the side of a surface that w points to. @param medium  where the ray came from
[[nodiscard]] inline std::int32_t medium_behind(const Scene& scene, const Surface& s, Vec3f w, std::int32_t medium) noexcept {
    if (scene.boundaries.empty()) return -1;
    const MediumBoundary& b = scene.boundaries[s.geometry];
    if (!b.ends_media) return medium;
    return dot(w, s.ng) > 0.0f ? b.exterior : b.interior;
}

/// How far a surface lies along a ray with a unit direction.
[[nodiscard]] inline float distance_along(const Ray& ray, const Surface& s) noexcept { return length(s.p - ray.o); }

/// What comes through, and with which probability a path would have come the same way without a vertex.
struct Reached {
    Vec3f transmittance{0.0f};
    float way = 1.0f;
};

/// Follows shadow rays. One for each path.
template <EffectSet kEffects>
class ShadowWalk {
public:
    ShadowWalk(const Scene& scene, bool crosses, Draws& draws, RayCounts& rays) noexcept
        : scene_(scene), crosses_(crosses), draws_(draws), rays_(rays) {}

    /// @param shadow  to the light: to o + d if `finite`, else to infinity along the unit vector d
    /// @param medium  index of the one that it starts in, or -1
    /// @param bounce  of the vertex; its steps are numbered through
    /// @return        transmittance zero where something is in between; NaN where a ray cannot be traced
    template <class Observer>
    [[nodiscard]] Reached reach(Ray shadow, bool finite, std::int32_t medium, const PathWeight& weight, std::size_t bounce,
                                Observer& observer) noexcept {
        const Ray whole = shadow;
        const Vec3f target = shadow.o + shadow.d;
        Vec3f through{1.0f};
        Reached out{Vec3f(1.0f), 1.0f};
        step_ = 0;
        for (;;) {
            ++rays_.shadow;
            Hit hit;
            if (crosses_)
                hit = closest_hit<kEffects>(scene_, shadow);
            else if (scene_.accelerator.occluded(shadow))
                out.transmittance = Vec3f(0.0f);
            if (!hit.valid()) {
                if (medium >= 0 && max_component(out.transmittance) > 0.0f)
                    track(medium, shadow, finite ? length(target - shadow.o) : kInfinity, bounce, through);
                break;
            }
            const Surface surface = surface_at<kEffects>(scene_, shadow, hit);
            const LocalBsdf local = bsdf_at<kEffects>(scene_, surface, -shadow.d);
            const Vec3f d = finite ? normalize(shadow.d) : shadow.d;
            const Passage passage = passage_at(scene_, local.layered, local.frame.to_local(-d));
            out.transmittance *= passage.transmittance;
            out.way *= passage.probability;
            if (!(max_component(out.transmittance) > 0.0f)) break;
            if (medium >= 0) track(medium, shadow, length(surface.p - shadow.o), bounce, through);
            if (!(max_component(through) > 0.0f)) break;
            medium = medium_behind(scene_, surface, d, medium);
            shadow.o = offset_origin(surface.p, surface.p_error, surface.ng, d);
            if (finite) {
                const Vec3f rest = target - shadow.o;
                if (!(dot(rest, d) > 0.0f)) break;
                shadow.d = rest;
            }
            if (!is_traceable(shadow.o, shadow.d)) return {Vec3f(std::numeric_limits<float>::quiet_NaN()), 0.0f};
        }
        out.transmittance *= through;
        out.way *= weight.mean(through);
        observer.shadow(whole, max_component(out.transmittance) > 0.0f);
        return out;
    }

private:
    void track(std::int32_t index, const Ray& shadow, float distance, std::size_t bounce, Vec3f& through) noexcept {
        const MediumRecord& medium = scene_.media[static_cast<std::size_t>(index)];
        if (!medium.heterogeneous) {
            through *= beam_transmittance(medium, distance);
        } else if constexpr (kEffects.has(Effect::heterogeneous)) {
            const auto next = [&] { return draws_.tail(bounce, SlotRole::transmittance, step_++); };
            through *= track_transmittance(medium, shadow.o, normalize(shadow.d), 0.0f, distance, next);
        }
    }

    const Scene& scene_;
    bool crosses_;
    Draws& draws_;
    RayCounts& rays_;
    std::uint32_t step_ = 0;
};

}  // namespace koksma
