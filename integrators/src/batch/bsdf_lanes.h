// BSDFs of packs: those that have a pack version together, layered ones lane by lane through the functions of the reference kernel.

KOKSMA_MATHS_BEGIN

template <EffectSet kEffects>
[[nodiscard]] Mask layered_lanes(const LocalBsdfPack& local, Mask active) {
    if constexpr (kEffects.has(Effect::layered)) return active & is_layered(local.bsdf);
    return Mask{};
}

/// Calls f(lane, point) for layered lanes.
template <EffectSet kEffects, class F>
void for_layered(const LocalBsdfPack& local, Mask layered, F&& f) {
    alignas(4 * kLanes) IntLanes side, geometry, primitive, instance;
    local.side.store(side);
    local.geometry.store(geometry);
    local.primitive.store(primitive);
    local.instance.store(instance);
    const SurfaceUvLanes<kEffects> uv(local.uv);
    const NumberLanes time(local.time);
    const VectorLanes n(local.n);
    for_lanes(layered, [&](int i) {
        f(i, LayeredPoint{static_cast<std::uint32_t>(side[i]),
                          uv[i],
                          n[i],
                          static_cast<std::uint32_t>(geometry[i]),
                          static_cast<std::uint32_t>(primitive[i]),
                          static_cast<std::uint32_t>(instance[i]),
                          time.x[i]});
    });
}

/// As koksma::eval_local.
template <EffectSet kEffects>
[[nodiscard]] BsdfValueOf<Float> eval_pack(const Scene& scene, const LocalBsdfPack& local, Mask active, const Vec3<Float>& wo, const Vec3<Float>& wi) {
    BsdfValueOf<Float> out = eval_bsdf<kEffects>(local.bsdf, wo, wi);
    if (const Mask layered = layered_lanes<kEffects>(local, active); any(layered)) {
        const VectorLanes from(wo), to(wi);
        VectorLanes f_cos(out.f_cos);
        NumberLanes pdf(out.pdf_w);
        for_layered<kEffects>(local, layered, [&](int i, const LayeredPoint& at) {
            const BsdfValue v = eval_layered(scene, at, from[i], to[i]);
            f_cos.set(i, v.f_cos);
            pdf.x[i] = v.pdf_w;
        });
        out.f_cos = f_cos.pack();
        out.pdf_w = pdf.pack();
    }
    return out;
}

/// As koksma::sample_local.
template <EffectSet kEffects>
[[nodiscard]] BsdfSampleOf<Float> sample_pack(const Scene& scene, const LocalBsdfPack& local, Mask active, const Vec3<Float>& wo, Float u_lobe, Vec2<Float> u) {
    BsdfSampleOf<Float> out = sample_bsdf<kEffects>(local.bsdf, wo, u_lobe, u);
    if (const Mask layered = layered_lanes<kEffects>(local, active); any(layered)) {
        const VectorLanes from(wo);
        const NumberLanes lobe(u_lobe), x(u.x), y(u.y);
        VectorLanes wi(out.wi), weight(out.weight);
        NumberLanes pdf(out.pdf_w), eta(out.eta);
        std::uint32_t delta = 0;
        for_layered<kEffects>(local, layered, [&](int i, const LayeredPoint& at) {
            const BsdfSample s = sample_layered(scene, at, from[i], lobe.x[i], {x.x[i], y.x[i]});
            wi.set(i, s.wi);
            weight.set(i, s.weight);
            pdf.x[i] = s.pdf_w;
            eta.x[i] = s.eta;
            delta |= static_cast<std::uint32_t>(s.delta) << i;
        });
        out.wi = wi.pack();
        out.weight = weight.pack();
        out.pdf_w = pdf.pack();
        out.eta = eta.pack();
        out.delta = (out.delta & !layered) | mask_of(delta);
    }
    return out;
}

/// As koksma::lit_normal_of.
template <EffectSet kEffects>
[[nodiscard]] Vec3<Float> lit_normal_pack(const LocalBsdfPack& local, const Vec3<Float>& wo_local) {
    if constexpr (kEffects.has(Effect::layered)) return lit_normal(local.bsdf, local.frame.n, wo_local.z);
    return local.frame.n;
}

KOKSMA_MATHS_END
