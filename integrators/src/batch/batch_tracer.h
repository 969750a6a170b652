// The batch kernel: the same estimator as trace_path (path.h), for thousands of paths at a time. All paths take a bounce
// together: rays are traced in packets, a packet's hits are shaded while they are in the cache, shadow rays wait in a queue
// of their own until the bounce is done. Paths that end leave the queue. Each path's sums are made in the order of the
// reference kernel, by the same formulas, so the bytes are the same.

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
KOKSMA_MATHS_BEGIN
template <EffectSet kEffects>
std::unique_ptr<Tracer> make_batch_tracer(const TraceJob&) {
    return nullptr;  // a machine without packs runs the reference kernel
}
KOKSMA_MATHS_END
#else

// In the order in which they build on each other.
#include "pack_access.h"
#include "distribution_pack.h"
#include "surface_pack.h"
#include "light_pack.h"
#include "bsdf_lanes.h"
#include "batch_numbers.h"
#include "ray_order.h"
#include "mirrored_rays.h"
#include "path_moves.h"
#include "camera_paths.h"
#include "path_sums.h"
#include "shadow_rays.h"
#include "sky_places.h"
#include "escaped_rays.h"
#include "sky_samples.h"

KOKSMA_MATHS_BEGIN

template <EffectSet kEffects>
class BatchTracer final : public Tracer {
    static constexpr bool kSmooth = kEffects.has(Effect::diffuse) || kEffects.has(Effect::glossy);
    static constexpr bool kExtendedLights = kEffects.has(Effect::area_light) || kEffects.has(Effect::environment);
    static constexpr bool kPosition = kEffects.has(Effect::area_light) || kEffects.has(Effect::many_lights);  ///< is asked where a path was
    static constexpr bool kInstancing = kEffects.has(Effect::instancing), kMotion = kEffects.has(Effect::motion);
    static constexpr bool kDelta = kEffects.has(Effect::specular) || kEffects.has(Effect::dielectric);
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

    /// Paths whose rays are all traced before the first is shaded: what they met is on its way to the cache meanwhile.
    static constexpr std::size_t kGroup = 16 * kPack;

public:
    explicit BatchTracer(const TraceJob& job)
        : scene_(job.scene),
          settings_(job.plan.integrator),
          numbers_(job, stats_),
          single_light_(job.scene),
          paths_(std::make_unique<detail::PathQueue>()),
          shadows_(job.scene),
          escaped_(job.scene),
          sky_(job.scene),
          order_(job.scene),
          surfaces_shine_(std::ranges::any_of(job.scene.geometries, [](const GeometryRecord& g) { return g.light >= 0; })) {
        for (std::uint32_t& m : packet_.mask) m = ~0u;
    }

    void trace(std::span<const SampleId> ids, std::span<Vec3f> radiance, std::span<std::uint64_t> hashes) noexcept override {
        sums_ = {radiance, hashes};
        sums_.clear();
        numbers_.begin_batch();
        if (numbers_.timed()) stats_.timed_paths += ids.size();
        if (settings_.max_depth == 0) return;
        numbers_.fill_camera(ids);
        start_paths<kEffects>(scene_.camera, numbers_, ids, *paths_);
        alive_ = ids.size();
        for (depth_ = 0; alive_ > 0; ++depth_) {
            last_vertex_ = settings_.max_depth >= 0 && depth_ + 1 >= settings_.max_depth;
            const std::size_t count = alive_;
            if (!last_vertex_) numbers_.begin_bounce(static_cast<std::size_t>(depth_), {paths_->id, count});
            if constexpr (kEffects.has(Effect::environment) && kSmooth) sky_drawn_ = sky_.usable() && !last_vertex_ && numbers_.are_laid_out();
            alive_ = 0;
            sorted_ = depth_ > 0 && order_.pays();  // never by the number of rays: Embree answers by flag
            if (sorted_) trace_in_order(count);
            for (std::size_t at = 0; at < count; at += kGroup) bounce_group(at, at + kGroup < count ? at + kGroup : count);
            stats_.rays.shadow += shadows_.trace(sorted_ ? &order_ : nullptr, sums_);
        }
    }

private:
    /// A few packs of paths, in steps.
    void bounce_group(std::size_t first, std::size_t end) {
        if (!sorted_) trace_group(first, end);
        const std::size_t hits = settle(first, end);
        const auto each = [&](auto&& step) {
            for (std::size_t at = first; at < hits; at += kPack) step(at, Mask::first(hits - at));
        };
        if (!last_vertex_ && hits > first) numbers_.fill_bounce(first, hits - first);
        if constexpr (kEffects.has(Effect::environment) && kSmooth) {
            if (sky_drawn_) {
                each([&](std::size_t at, Mask active) {
                    sky_.want(at - first, active, Int32::load(met_.geometry + at), numbers_.get_2d(at, active, SlotRole::light_position, &BounceSlots::light_position));
                });
                sky_.find();
            }
        }
        if constexpr (kEffects.has(Effect::environment)) escaped_.find();
        if constexpr (kEffects.has(Effect::environment) && kSmooth)
            if (sky_drawn_) sky_.draw();
        group_ = first;
        each([&](std::size_t at, Mask active) { bounce(at, active); });
        if constexpr (kEffects.has(Effect::environment)) escaped_.add(sums_);
    }

    /// What the rays of a group meet.
    void trace_group(std::size_t first, std::size_t end) {
        if constexpr (kDelta)
            if (depth_ == 1 && trace_split(first, end)) return;
        for (std::size_t at = first; at < end; at += kPack) trace_pack(at, Mask::first(end - at));
    }

    /// Takes leave of those paths of a group that met nothing, and moves the others together, so that packs are full.
    /// @return  where these end
    std::size_t settle(std::size_t first, std::size_t end) {
        const detail::PathQueue& q = *paths_;
        std::size_t to = first;
        for (std::size_t at = first; at < end; at += kPack) {
            Int32::load(q.slot + at).store(slots_);
            const Vec3<Float> d = load(q.d, at);
            const Mask active = only_traceable(Mask::first(end - at), load(q.o, at), d);
            stats_.rays.closest += static_cast<std::uint64_t>(count(active));
            const Int32 geometry = Int32::load(met_.geometry + at);
            if (!sums_.hashes.empty()) hash_hits(active, geometry, at);
            const Mask hit = active & (geometry != Int32(-1));
            if constexpr (kEffects.has(Effect::environment))
                if (const Mask escaped = active & !hit; any(escaped)) queue_escaped(at, escaped, d, load(q.beta, at));
            to = move_together<kEffects>(*paths_, met_, hit, at, to, surfaces_shine_);
        }
        return to;
    }

    /// What the rays of a pack meet.
    void trace_pack(std::size_t at, Mask active) {
        const detail::PathQueue& q = *paths_;
        const Vec3<Float> o = load(q.o, at), d = load(q.d, at);
        const bool camera = depth_ == 0;
        const Mask sent = active & is_traceable(o, d);
        Float time{};
        if constexpr (kMotion) time = Float::load(q.time + at);
        closest_hit(sent, o, d, camera ? Float::load(q.t_near + at) : Float(0.0f), camera ? Float::load(q.t_far + at) : Float(kInfinity),
                    time, camera ? Coherence::coherent : Coherence::incoherent);
        Int32 geometry = as_int(UInt32::load(packet_.geometry));
        const Int32 primitive = as_int(UInt32::load(packet_.primitive));
        if constexpr (kInstancing) resolve_instances(sent, geometry).store(met_.instance + at);
        geometry.store(met_.geometry + at);
        primitive.store(met_.primitive + at);
        if (!order_.pays()) prefetch_triangles(scene_, active & (geometry != Int32(-1)), geometry, primitive);
    }

    /// What the rays of a group meet behind a camera ray's first surface, if some are mirrored or refracted there: these are coherent
    /// still, so they are traced by themselves. @return  false: none is
    bool trace_split(std::size_t first, std::size_t end) {
        if (!mirrored_.sort(*paths_, first, end)) return false;
        for (const auto& rays : mirrored_.rays())
            for (std::size_t at = 0; at < rays.count; at += kPack)
                trace_places(Int32::load(rays.place + at), Mask::first(rays.count - at), rays.coherence);
        return true;
    }

    /// What the rays of a pack meet that are not side by side in the queue.
    void trace_places(Int32 place, Mask active, Coherence coherence) {
        const detail::PathQueue& q = *paths_;
        const Vec3<Float> o = gather(q.o, place), d = gather(q.d, place);
        const Mask sent = active & is_traceable(o, d);
        Float time{};
        if constexpr (kMotion) time = gather(q.time, place);
        closest_hit(sent, o, d, Float(0.0f), Float(kInfinity), time, coherence);
        Int32 geometry = as_int(UInt32::load(packet_.geometry));
        const Int32 primitive = as_int(UInt32::load(packet_.primitive));
        alignas(4 * kLanes) IntLanes places, geometries, primitives, instances;
        if constexpr (kInstancing) resolve_instances(sent, geometry).store(instances);
        place.store(places);
        geometry.store(geometries);
        primitive.store(primitives);
        for_lanes(active, [&](int i) {
            met_.geometry[places[i]] = geometries[i];
            met_.primitive[places[i]] = primitives[i];
            if constexpr (kInstancing) met_.instance[places[i]] = instances[i];
        });
        if (!order_.pays()) prefetch_triangles(scene_, active & (geometry != Int32(-1)), geometry, primitive);
    }

    /// One pack of paths: from what its rays met to the next rays.
    KOKSMA_FLATTEN void bounce(std::size_t at, Mask hit) {
        detail::PathQueue& q = *paths_;
        const Vec3<Float> o = load(q.o, at), d = load(q.d, at);
        Vec3<Float> beta = load(q.beta, at);
        Int32::load(q.slot + at).store(slots_);
        const Int32 geometry = Int32::load(met_.geometry + at), primitive = Int32::load(met_.primitive + at);
        Int32 instance(-1);
        Float time{};
        if constexpr (kInstancing)
            if (!sorted_) instance = Int32::load(met_.instance + at);  // scenes that are sorted have none
        if constexpr (kMotion) time = Float::load(q.time + at);
        const SurfacePack surface = surface_pack<kEffects>(scene_, hit, o, d, geometry, primitive, instance, time);
        const Vec3<Float> wo = -d;

        // ---- light that the surfaces themselves send out
        if constexpr (kEffects.has(Effect::area_light))
            if (const Mask shines = hit & (surface.light >= Int32(0)); any(shines)) add_emission(at, shines, surface, primitive, d, beta);
        if (last_vertex_) return;

        const LocalBsdfPack local = bsdf_pack<kEffects>(scene_, surface, hit, wo);
        const Vec3<Float> wo_local = local.frame.to_local(wo);

        // ---- light that arrives straight from a light source
        Mask alive = hit;
        if constexpr (kSmooth)
            if (const Mask smooth = hit & has_smooth_lobe(local.bsdf); scene_.light_choice.total() > 0.0 && any(smooth))
                alive = direct_light(at, alive, smooth, surface, local, wo_local, beta, time);

        // ---- where the paths go on
        Float u_lobe{};
        if constexpr (kEffects.has(Effect::lobe))
            if (const Mask m = alive & chooses_lobe(local.bsdf); any(m))
                u_lobe = numbers_.get_1d(at, m, SlotRole::lobe, &BounceSlots::lobe);
        Vec2<Float> u_direction{};
        if constexpr (kSmooth)
            if (const Mask m = alive & has_smooth_lobe(local.bsdf); any(m))
                u_direction = numbers_.get_2d(at, m, SlotRole::direction, &BounceSlots::direction);
        const BsdfSampleOf<Float> next = sample_pack<kEffects>(scene_, local, alive, wo_local, u_lobe, u_direction);
        alive = alive & !(next.pdf_w <= Float(0.0f));
        beta *= next.weight;
        const Float total = sum(beta);
        if (const Mask odd = alive & (!(total > Float(0.0f)) | !(next.pdf_w > Float(0.0f))); any(odd)) {
            invalidate(odd & !(total <= Float(0.0f)));  // not a number: to be counted, not to end in silence
            alive = alive & !odd;
        }
        Float eta_scale{1.0f};
        if constexpr (kEffects.has(Effect::dielectric)) {
            eta_scale = Float::load(q.eta_scale + at);
            eta_scale = eta_scale * (next.eta * next.eta);
        }
        const Vec3<Float> wi = local.frame.to_world(next.wi);
        const Vec3<Float> origin = offset_origin(surface.p, surface.p_error, surface.ng, wi);

        // ---- Russian roulette
        Int32 lossless{};
        if constexpr (kEffects.has(Effect::roulette))
            if (depth_ + 1 >= settings_.rr_depth) alive = roulette(at, alive, beta, eta_scale, lossless);
        if (!any(alive)) return;

        // ---- those that go on move to the front of the queue, behind all that has been read
        const std::size_t to = alive_;
        compress_store(origin, alive, q.o, to);
        compress_store(wi, alive, q.d, to);
        compress_store(beta, alive, q.beta, to);
        next.pdf_w.compress_store(alive, q.pdf + to);
        if constexpr (kPosition) compress_store(surface.p, alive, q.last_p, to);
        if constexpr (kEffects.has(Effect::many_lights)) compress_store(lit_normal_pack<kEffects>(local, wo_local), alive, q.last_n, to);
        if constexpr (kMotion) time.compress_store(alive, q.time + to);
        if constexpr (kEffects.has(Effect::dielectric)) eta_scale.compress_store(alive, q.eta_scale + to);
        if constexpr (kEffects.has(Effect::roulette)) lossless.compress_store(alive, q.lossless + to);
        if constexpr (kDelta)
            select(next.delta, Int32(-1), Int32(0)).compress_store(alive, q.delta + to);
        else
            Int32(0).store_any(q.delta + to);
        Int32::load(slots_).compress_store(alive, q.slot + to);
        std::size_t free = to;
        for_lanes(alive, [&](int i) { q.id[free++] = q.id[at + static_cast<std::size_t>(i)]; });
        alive_ = free;
    }

    /// Asks Embree; the answer is in packet_.
    void closest_hit(Mask active, const Vec3<Float>& o, const Vec3<Float>& d, Float t_near, Float t_far, Float time, Coherence coherence) {
        o.x.store(packet_.o_x);
        o.y.store(packet_.o_y);
        o.z.store(packet_.o_z);
        d.x.store(packet_.d_x);
        d.y.store(packet_.d_y);
        d.z.store(packet_.d_z);
        t_near.store(packet_.t_near);
        t_far.store(packet_.t_far);
        if constexpr (kMotion) time.store(packet_.time);
        if constexpr (kInstancing) UInt32(Hit::kNone).store(packet_.instance[0]);
        UInt32(Hit::kNone).store(packet_.geometry);
        select(active, Int32(-1), Int32(0)).store(valid_);
        scene_.accelerator.intersect(packet_, valid_, coherence);
    }

    /// Turns the packet's ids of what is seen through instances into the scene's, as koksma::closest_hit does. @return  instances; -1: none
    [[nodiscard]] Int32 resolve_instances(Mask active, Int32& geometry) {
        const Int32 met = as_int(UInt32::load(packet_.instance[0]));
        const Mask through = active & (geometry != Int32(-1)) & (met != Int32(-1));
        if (!any(through)) return Int32(-1);
        alignas(4 * kLanes) IntLanes instances, geometries;
        Int32(-1).store(instances);
        geometry.store(geometries);
        for_lanes(through, [&](int i) {
            const std::uint32_t instance = packet_.instance[0][i] - scene_.first_instance;
            instances[i] = static_cast<std::int32_t>(instance);
            geometries[i] += static_cast<std::int32_t>(scene_.instances[instance].first_geometry);
        });
        geometry = Int32::load(geometries);
        return Int32::load(instances);
    }

    /// Finds what the rays of the queue meet, neighbours in direction and place together.
    void trace_in_order(std::size_t count) {
        const std::size_t good = order_.sort(paths_->o, paths_->d, count);
        for (std::size_t at = 0; at < good; at += kPack) trace_places(order_.place(at), Mask::first(good - at), Coherence::coherent);
    }

    void hash_hits(Mask active, Int32 geometry, std::size_t at) {
        alignas(4 * kLanes) IntLanes g;
        geometry.store(g);
        for_lanes(active, [&](int i) {
            const std::size_t path = at + static_cast<std::size_t>(i);
            const auto met = static_cast<std::uint32_t>(g[i]), which = met == Hit::kNone ? Hit::kNone : static_cast<std::uint32_t>(met_.primitive[path]);
            sums_.hash(slots_[i], (std::uint64_t{met} << 32) | which);
            if constexpr (kInstancing)
                if (!sorted_ && met_.instance[path] != -1) sums_.hash(slots_[i], static_cast<std::uint32_t>(met_.instance[path]));
        });
    }

    void queue_escaped(std::size_t at, Mask escaped, const Vec3<Float>& d, const Vec3<Float>& beta) {
        if (scene_.environment_light < 0 || (depth_ == 0 && settings_.hide_emitters)) return;
        const Mask delta = Int32::load(paths_->delta + at) != Int32(0);
        Float probability;
        if constexpr (kEffects.has(Effect::many_lights)) {
            NumberLanes lanes(Float(1.0f));
            for_lanes(escaped & !delta,
                      [&](int i) { lanes.x[i] = light_probability(at + static_cast<std::size_t>(i), environment_light(), kWholeLight); });
            probability = lanes.pack();
        } else {
            probability = Float(light_probability(at, environment_light(), kWholeLight));
        }
        escaped_.queue(escaped, d, beta, delta, Float::load(paths_->pdf + at), probability, Int32::load(slots_));
    }

    [[nodiscard]] std::uint32_t environment_light() const { return static_cast<std::uint32_t>(scene_.environment_light); }

    void add_emission(std::size_t at, Mask shines, const SurfacePack& s, Int32 primitive, const Vec3<Float>& d, const Vec3<Float>& beta) {
        if (depth_ == 0 && settings_.hide_emitters) return;
        const VectorLanes p(s.p), ng(s.ng), n(s.n), directions(d), betas(beta);
        const NumberLanes u(s.uv.x), v(s.uv.y);
        alignas(4 * kLanes) IntLanes geometry, light, primitives;
        s.geometry.store(geometry);
        s.light.store(light);
        primitive.store(primitives);
        for_lanes(shines, [&](int i) {
            const std::size_t path = at + static_cast<std::size_t>(i);
            const Vec3f wi = directions[i];
            Surface surface{.p = p[i], .ng = ng[i], .n = n[i], .uv = {u.x[i], v.x[i]}, .geometry = static_cast<std::uint32_t>(geometry[i])};
            const Vec3f le = emitted<kEffects>(scene_, surface, -wi);
            if (!(koksma::max_component(le) > 0.0f)) return;
            float weight = 1.0f;
            if (paths_->delta[path] == 0) {
                const auto index = static_cast<std::uint32_t>(light[i]);
                const std::uint32_t triangle = chosen_triangle<kEffects>(scene_, index, static_cast<std::uint32_t>(primitives[i]));
                weight = koksma::power_heuristic(
                    paths_->pdf[path],
                    light_pdf<kEffects>(scene_, scene_.lights[index], vector(paths_->last_p, path), surface, wi, triangle) *
                        light_probability(path, index, triangle));
            }
            sums_.add(slots_[i], betas[i] * le * weight);
        });
    }

    /// @param choice  gets the light
    [[nodiscard]] LightSamplePack sample_light(std::size_t at, Mask smooth, const SurfacePack& s, const LocalBsdfPack& local, const Vec3<Float>& wo_local,
                                               LightChoicePack& choice) {
        if constexpr (kEffects.has(Effect::light_choice))
            choice = choose_light_pack<kEffects>(scene_, smooth, s.p, lit_normal_pack<kEffects>(local, wo_local),
                                                 numbers_.get_1d(at, smooth, SlotRole::light_choice, &BounceSlots::light_choice));
        Vec2<Float> u_light{};
        if constexpr (kExtendedLights) u_light = numbers_.get_2d(at, smooth, SlotRole::light_position, &BounceSlots::light_position);
        return sample_light_pack<kEffects>(scene_, single_light_, smooth, choice, s.p, u_light);
    }

    /// Queues the shadow rays of a pack. @return  the lanes of `alive` that stay valid
    Mask direct_light(std::size_t at, Mask alive, Mask smooth, const SurfacePack& s, const LocalBsdfPack& local,
                      const Vec3<Float>& wo_local, const Vec3<Float>& beta, Float time) {
        LightChoicePack choice = LightChoicePack::only();
        const LightSamplePack light = sky_drawn_ ? sky_.get(at - group_) : sample_light(at, smooth, s, local, wo_local, choice);
        Mask lit = smooth & (light.pdf_w > Float(0.0f)) & (choice.probability > Float(0.0f));
        if (!any(lit)) return alive;
        const BsdfValueOf<Float> value = eval_pack<kEffects>(scene_, local, lit, wo_local, local.frame.to_local(light.wi));
        const Float pdf_light = light.pdf_w * choice.probability;
        const Float weight = select(light.delta, Float(1.0f), power_heuristic(pdf_light, value.pdf_w));
        const Vec3<Float> contribution = beta * value.f_cos * light.radiance * (weight / pdf_light);
        lit = lit & !(sum(contribution) <= Float(0.0f));  // a NaN goes on, to be counted
        if (!any(lit)) return alive;
        const Vec3<Float> o = offset_origin(s.p, s.p_error, s.ng, light.wi);
        const Vec3<Float> d = select<Float>(light.at_infinity, light.wi, light.target - o);
        if (const Mask odd = lit & !is_traceable(o, d); any(odd)) {
            invalidate(odd);
            alive = alive & !odd;
            lit = lit & !odd;
        }
        shadows_.queue(lit, o, d, select(light.at_infinity, Float(kInfinity), Float(1.0f)), time, contribution, Int32::load(slots_));
        return alive;
    }

    /// @return  the lanes that survive; beta is divided by their chance
    Mask roulette(std::size_t at, Mask alive, Vec3<Float>& beta, Float eta_scale, Int32& lossless) {
        Float survival = max_component(beta) * eta_scale;
        lossless = select(survival < Float(1.0f), Int32(0), Int32::load(paths_->lossless + at) + Int32(1));
        survival = select(lossless > Int32(kLosslessBounces), Float(0.9f), survival);
        const Mask plays = alive & (survival < Float(1.0f));
        if (!any(plays)) return alive;
        const Float u = numbers_.get_1d(at, plays, SlotRole::roulette, &BounceSlots::roulette);
        const Mask survives = plays & (u < survival);
        assign<Float>(survives, beta, beta * (Float(1.0f) / survival));
        return (alive & !plays) | survives;
    }

    /// Ends the paths that Embree may not see.
    Mask only_traceable(Mask active, const Vec3<Float>& o, const Vec3<Float>& d) {
        const Mask good = active & is_traceable(o, d);
        if (const Mask bad = active & !good; any(bad)) invalidate(bad);
        return good;
    }
    void invalidate(Mask lanes) {
        for_lanes(lanes, [&](int i) { sums_.spoil(slots_[i]); });
    }
    [[nodiscard]] static Vec3f vector(const detail::VectorRows& rows, std::size_t at) { return {rows.x[at], rows.y[at], rows.z[at]}; }
    /// Of a light that a path met without looking for it.
    [[nodiscard]] float light_probability(std::size_t path, std::uint32_t light, std::uint32_t triangle) const {
        if constexpr (kEffects.has(Effect::many_lights))
            return choice_probability<kEffects>(scene_, light, triangle, vector(paths_->last_p, path), vector(paths_->last_n, path));
        return choice_probability<kEffects>(scene_, light, triangle, Vec3f{}, Vec3f{});
    }

    const Scene& scene_;
    const IntegratorSettings& settings_;
    BatchNumbers numbers_;
    const SingleLight single_light_;
    std::unique_ptr<detail::PathQueue> paths_;
    ShadowRays<kEffects> shadows_;
    EscapedRays<kGroup> escaped_;
    SkySamples<kEffects, kGroup> sky_;
    RayOrder order_;
    MirroredRays<kEffects, kGroup> mirrored_;
    const bool surfaces_shine_;
    RayPacket<kLanes> packet_{};
    detail::Met met_{};
    alignas(4 * kLanes) IntLanes valid_{}, slots_{};
    PathSums sums_;
    std::size_t alive_ = 0;
    std::int32_t depth_ = 0;
    std::size_t group_ = 0;  ///< where the group begins that is being shaded
    bool last_vertex_ = false, sorted_ = false, sky_drawn_ = false;
};

template <EffectSet kEffects>
std::unique_ptr<Tracer> make_batch_tracer(const TraceJob& job) {
    return std::make_unique<BatchTracer<kEffects> >(job);
}

KOKSMA_MATHS_END
#endif
