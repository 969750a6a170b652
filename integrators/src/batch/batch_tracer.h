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

KOKSMA_MATHS_BEGIN

template <EffectSet kEffects>
class BatchTracer final : public Tracer {
    static constexpr bool kSmooth = kEffects.has(Effect::diffuse) || kEffects.has(Effect::glossy);
    static constexpr bool kExtendedLights = kEffects.has(Effect::area_light) || kEffects.has(Effect::environment);
    static constexpr bool kInstancing = kEffects.has(Effect::instancing), kMotion = kEffects.has(Effect::motion);
    static constexpr bool kDelta = kEffects.has(Effect::specular) || kEffects.has(Effect::dielectric);
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

    /// Paths whose rays are all traced before the first is shaded: what they met is on its way to the cache meanwhile.
    static constexpr std::size_t kGroup = 8 * kPack;

public:
    explicit BatchTracer(const TraceJob& job)
        : scene_(job.scene),
          settings_(job.plan.integrator),
          numbers_(job, stats_),
          single_light_(job.scene),
          paths_(std::make_unique<detail::PathQueue>()),
          shadows_(std::make_unique<detail::ShadowQueue>()),
          escaped_(std::make_unique<detail::EscapeQueue>()),
          order_(job.scene) {
        for (std::uint32_t& m : packet_.mask) m = ~0u;
    }

    void trace(std::span<const SampleId> ids, std::span<Vec3f> radiance, std::span<std::uint64_t> hashes) noexcept override {
        radiance_ = radiance;
        hashes_ = hashes;
        for (Vec3f& l : radiance_) l = Vec3f(0.0f);
        for (std::uint64_t& h : hashes_) h = 0;
        numbers_.begin_batch();
        if (numbers_.timed()) stats_.timed_paths += ids.size();
        if (settings_.max_depth == 0) return;
        start_paths(ids);
        alive_ = ids.size();
        for (depth_ = 0; alive_ > 0; ++depth_) {
            last_vertex_ = settings_.max_depth >= 0 && depth_ + 1 >= settings_.max_depth;
            if (!last_vertex_) numbers_.fill_bounce(static_cast<std::size_t>(depth_), {paths_->id, alive_});
            const std::size_t count = alive_;
            alive_ = waiting_ = 0;
            sorted_ = depth_ > 0 && order_.pays();  // never by the number of rays: Embree answers by flag
            if (sorted_) trace_in_order(count);
            for (std::size_t at = 0; at < count; at += kGroup) bounce_group(at, count);
            trace_shadow_rays();
        }
    }

private:
    /// Camera rays.
    void start_paths(std::span<const SampleId> ids) {
        detail::PathQueue& q = *paths_;
        numbers_.fill_camera(ids);
        for (std::size_t at = 0; at < ids.size(); at += kPack) {
            const Vec2<Float> u = numbers_.film(at);
            NumberLanes x(u.x), y(u.y);
            for (std::size_t i = 0; i < kPack && at + i < ids.size(); ++i) {
                const SampleId& id = ids[at + i];
                const Vec2f film = film_point(scene_.camera, id.pixel.x, id.pixel.y, {x.x[i], y.x[i]});
                x.x[i] = film.x;
                y.x[i] = film.y;
                q.id[at + i] = id;
            }
            Vec2<Float> u_lens{};
            if constexpr (kEffects.has(Effect::lens)) u_lens = numbers_.lens(at);
            const CameraRayOf<Float> ray = camera_ray(scene_.camera, Vec2<Float>{x.pack(), y.pack()}, u_lens);
            store(ray.o, q.o, at);
            store(ray.d, q.d, at);
            ray.t_near.store(q.t_near + at);
            ray.t_far.store(q.t_far + at);
            store(Vec3<Float>(Float(1.0f)), q.beta, at);
            if constexpr (kMotion) numbers_.time(at).store(q.time + at);
            Float(1.0f).store(q.eta_scale + at);
            Float(0.0f).store(q.pdf + at);
            Int32(-1).store(q.delta + at);
            Int32(0).store(q.lossless + at);
            store(Vec3<Float>(Float(0.0f)), q.last_p, at);
            store(Vec3<Float>{Float(0.0f), Float(0.0f), Float(1.0f)}, q.last_n, at);
            iota(static_cast<std::int32_t>(at)).store(q.slot + at);
        }
    }

    /// A few packs of paths, in steps.
    void bounce_group(std::size_t first, std::size_t count) {
        const auto each = [&](auto&& step) {
            for (std::size_t at = first; at < first + kGroup && at < count; at += kPack) step(at, Mask::first(count - at));
        };
        if (!sorted_) each([&](std::size_t at, Mask active) { trace_pack(at, active); });
        if (!order_.pays())
            each([&](std::size_t at, Mask active) {
                const Int32 geometry = Int32::load(geometry_ + at);
                prefetch_vertices<kEffects>(scene_, active & (geometry != Int32(-1)), geometry, Int32::load(primitive_ + at));
            });
        each([&](std::size_t at, Mask active) { bounce(at, active); });
        if constexpr (kEffects.has(Effect::environment)) add_environment();
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
        if constexpr (kInstancing) resolve_instances(sent, geometry).store(instance_ + at);
        geometry.store(geometry_ + at);
        primitive.store(primitive_ + at);
        if (!order_.pays()) prefetch_triangles(scene_, active & (geometry != Int32(-1)), geometry, primitive);
    }

    /// One pack of paths: from what its rays met to the next rays.
    KOKSMA_FLATTEN void bounce(std::size_t at, Mask active) {
        detail::PathQueue& q = *paths_;
        const Vec3<Float> o = load(q.o, at), d = load(q.d, at);
        Vec3<Float> beta = load(q.beta, at);
        Int32::load(q.slot + at).store(slots_);

        // ---- where the rays go
        active = only_traceable(active, o, d);
        if (!any(active)) return;
        const Int32 geometry = Int32::load(geometry_ + at), primitive = Int32::load(primitive_ + at);
        Int32 instance(-1);
        Float time{};
        if constexpr (kInstancing)
            if (!sorted_) instance = Int32::load(instance_ + at);  // scenes that are sorted have none
        if constexpr (kMotion) time = Float::load(q.time + at);
        stats_.rays.closest += static_cast<std::uint64_t>(count(active));
        if (!hashes_.empty()) hash_hits(active, geometry, primitive, instance);
        const Mask hit = active & (geometry != Int32(-1));
        if constexpr (kEffects.has(Effect::environment))
            if (const Mask escaped = active & !hit; any(escaped)) queue_escaped(at, escaped, d, beta);
        if (!any(hit)) return;
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
        if constexpr (kEffects.has(Effect::area_light) || kEffects.has(Effect::many_lights)) compress_store(surface.p, alive, q.last_p, to);
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
        const detail::PathQueue& q = *paths_;
        const std::size_t good = order_.sort(q, count);
        for (std::size_t at = 0; at < good; at += kPack) {
            const Mask active = Mask::first(good - at);
            const Int32 place = order_.place(at);
            closest_hit(active, {gather(q.o.x, place), gather(q.o.y, place), gather(q.o.z, place)},
                        {gather(q.d.x, place), gather(q.d.y, place), gather(q.d.z, place)}, Float(0.0f), Float(kInfinity), Float(0.0f),
                        Coherence::coherent);
            alignas(4 * kLanes) IntLanes places;
            place.store(places);
            for (std::size_t i = 0; i < kPack && at + i < good; ++i) {
                geometry_[places[i]] = static_cast<std::int32_t>(packet_.geometry[i]);
                primitive_[places[i]] = static_cast<std::int32_t>(packet_.primitive[i]);
            }
        }
    }

    void hash_hits(Mask active, Int32 geometry, Int32 primitive, Int32 instance) {
        alignas(4 * kLanes) IntLanes g, p, through;
        geometry.store(g);
        primitive.store(p);
        instance.store(through);
        for_lanes(active, [&](int i) {
            const auto met = static_cast<std::uint32_t>(g[i]), which = met == Hit::kNone ? Hit::kNone : static_cast<std::uint32_t>(p[i]);
            hash(i, (std::uint64_t{met} << 32) | which);
            if (kInstancing && through[i] != -1) hash(i, static_cast<std::uint32_t>(through[i]));
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
        detail::EscapeQueue& q = *escaped_;
        compress_store(d, escaped, q.d, escapes_);
        compress_store(beta, escaped, q.beta, escapes_);
        select(delta, Float(-1.0f), Float::load(paths_->pdf + at)).compress_store(escaped, q.pdf + escapes_);
        probability.compress_store(escaped, q.probability + escapes_);
        escapes_ += Int32::load(slots_).compress_store(escaped, q.slot + escapes_);
    }

    /// What the escaped rays of a group bring: first all places in the map, so that it is there when it is read.
    void add_environment() {
        detail::EscapeQueue& q = *escaped_;
        const bool mapped = scene_.environment_map.has_value();
        const EnvironmentTable table = mapped ? scene_.environment_map->table() : EnvironmentTable{};
        if (mapped)
            for (std::size_t at = 0; at < escapes_; at += kPack) {
                const EnvironmentPlaceOf<Float> place = environment_place(table, load(q.d, at));
                place.x.store(q.d.x + at);
                place.y.store(q.d.y + at);
                place.column.store(q.column + at);
                place.row.store(q.row + at);
                const Mask active = Mask::first(escapes_ - at);
                const Int32 cell = place.row * Int32(table.width + 1) + place.column;
                prefetch(table.texels, active, cell);
                prefetch(table.texels + table.width + 1, active, cell);
                prefetch(table.begin, active & !(Float::load(q.pdf + at) < Float(0.0f)), cell);
            }
        for (std::size_t at = 0; at < escapes_; at += kPack) {
            const Mask active = Mask::first(escapes_ - at);
            const Float pdf = Float::load(q.pdf + at);
            const Mask delta = pdf < Float(0.0f);
            Vec3<Float> radiance;
            Float pdf_light(0.25f * kInvPi);
            if (mapped) {
                // Lanes beyond the last hold old places or zeros: the map has them.
                const EnvironmentPlaceOf<Float> place{Int32::load(q.column + at), Int32::load(q.row + at), Float::load(q.d.x + at),
                                                      Float::load(q.d.y + at)};
                radiance = environment_radiance(table, place);
                if (any(active & !delta)) pdf_light = environment_density(table, place);
            } else {
                radiance = Vec3<Float>::splat(scene_.lights[environment_light()].radiance.constant);
            }
            const Float weight = select(delta, Float(1.0f), power_heuristic(pdf, pdf_light * Float::load(q.probability + at)));
            const VectorLanes contribution(load(q.beta, at) * radiance * weight);
            Int32::load(q.slot + at).store(slots_);
            for_lanes(active, [&](int i) { this->radiance(i) += contribution[i]; });
        }
        escapes_ = 0;
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
            radiance(i) += betas[i] * le * weight;
        });
    }

    /// Queues the shadow rays of a pack. @return  the lanes of `alive` that stay valid
    Mask direct_light(std::size_t at, Mask alive, Mask smooth, const SurfacePack& s, const LocalBsdfPack& local,
                      const Vec3<Float>& wo_local, const Vec3<Float>& beta, Float time) {
        LightChoicePack choice = LightChoicePack::only();
        if constexpr (kEffects.has(Effect::light_choice))
            choice = choose_light_pack<kEffects>(scene_, smooth, s.p, lit_normal_pack<kEffects>(local, wo_local),
                                                 numbers_.get_1d(at, smooth, SlotRole::light_choice, &BounceSlots::light_choice));
        Vec2<Float> u_light{};
        if constexpr (kExtendedLights) u_light = numbers_.get_2d(at, smooth, SlotRole::light_position, &BounceSlots::light_position);
        const LightSamplePack light = sample_light_pack<kEffects>(scene_, single_light_, smooth, choice, s.p, u_light);
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
        detail::ShadowQueue& q = *shadows_;
        compress_store(o, lit, q.o, waiting_);
        compress_store(d, lit, q.d, waiting_);
        compress_store(contribution, lit, q.contribution, waiting_);
        if constexpr (kMotion) time.compress_store(lit, q.time + waiting_);
        select(light.at_infinity, Float(kInfinity), Float(1.0f)).compress_store(lit, q.t_far + waiting_);
        waiting_ += Int32::load(slots_).compress_store(lit, q.slot + waiting_);
        return alive;
    }

    void trace_shadow_rays() {
        const detail::ShadowQueue& q = *shadows_;
        stats_.rays.shadow += waiting_;
        for (std::size_t at = 0; at < waiting_; at += kPack) {
            const Mask active = Mask::first(waiting_ - at);
            Float::load(q.o.x + at).store(packet_.o_x);
            Float::load(q.o.y + at).store(packet_.o_y);
            Float::load(q.o.z + at).store(packet_.o_z);
            Float::load(q.d.x + at).store(packet_.d_x);
            Float::load(q.d.y + at).store(packet_.d_y);
            Float::load(q.d.z + at).store(packet_.d_z);
            Float(0.0f).store(packet_.t_near);
            if constexpr (kMotion) Float::load(q.time + at).store(packet_.time);
            Float::load(q.t_far + at).store(packet_.t_far);
            select(active, Int32(-1), Int32(0)).store(valid_);
            scene_.accelerator.occluded(packet_, valid_, Coherence::incoherent);  // also from camera hits: 0.63 to 0.99 of the time
            Int32::load(q.slot + at).store(slots_);
            const Mask visible = active & !(Float::load(packet_.t_far) < Float(0.0f));
            for_lanes(visible, [&](int i) {
                const std::size_t ray = at + static_cast<std::size_t>(i);
                radiance(i) += Vec3f{q.contribution.x[ray], q.contribution.y[ray], q.contribution.z[ray]};
            });
            if (!hashes_.empty()) {
                const std::uint32_t seen = lane_bits(visible);
                for_lanes(active, [&](int i) { hash(i, (seen >> i) & 1u); });
            }
        }
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
        constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
        for_lanes(lanes, [&](int i) { radiance(i) = {kNan, kNan, kNan}; });
    }
    [[nodiscard]] static Vec3f vector(const detail::VectorRows& rows, std::size_t at) { return {rows.x[at], rows.y[at], rows.z[at]}; }
    /// Of a light that a path met without looking for it.
    [[nodiscard]] float light_probability(std::size_t path, std::uint32_t light, std::uint32_t triangle) const {
        if constexpr (kEffects.has(Effect::many_lights))
            return choice_probability<kEffects>(scene_, light, triangle, vector(paths_->last_p, path), vector(paths_->last_n, path));
        return choice_probability<kEffects>(scene_, light, triangle, Vec3f{}, Vec3f{});
    }
    [[nodiscard]] Vec3f& radiance(int lane) { return radiance_[static_cast<std::size_t>(slots_[lane])]; }
    void hash(int lane, std::uint64_t what) {
        std::uint64_t& h = hashes_[static_cast<std::size_t>(slots_[lane])];
        h = path_hash(h, what);
    }

    const Scene& scene_;
    const IntegratorSettings& settings_;
    BatchNumbers numbers_;
    const SingleLight single_light_;
    std::unique_ptr<detail::PathQueue> paths_;
    std::unique_ptr<detail::ShadowQueue> shadows_;
    std::unique_ptr<detail::EscapeQueue> escaped_;
    RayOrder order_;
    RayPacket<kLanes> packet_{};
    alignas(64) detail::IntRow geometry_{}, primitive_{}, instance_{};  // what the rays met
    alignas(4 * kLanes) IntLanes valid_{}, slots_{};
    std::span<Vec3f> radiance_;
    std::span<std::uint64_t> hashes_;
    std::size_t alive_ = 0, waiting_ = 0, escapes_ = 0;
    std::int32_t depth_ = 0;
    bool last_vertex_ = false, sorted_ = false;
};

template <EffectSet kEffects>
std::unique_ptr<Tracer> make_batch_tracer(const TraceJob& job) {
    return std::make_unique<BatchTracer<kEffects> >(job);
}

KOKSMA_MATHS_END
#endif
