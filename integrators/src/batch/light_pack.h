// Light sampling for packs: triangles, parallelograms and points side by side, other lights one by one.

KOKSMA_MATHS_BEGIN

/// As koksma::LightSample.
struct LightSamplePack {
    Vec3<Float> wi, radiance, target;
    Float pdf_w;
    Mask delta, at_infinity;
};

/// As koksma::sample_light for lights made of triangles (parallelograms and meshes).
template <EffectSet kEffects>
[[nodiscard]] LightSamplePack sample_triangle_lights(const Scene& scene, Mask active, Int32 light, Vec3<Float> p, Vec2<Float> u) {
    const Light* lights = scene.lights.data();
    const Int32 kind = gather_int(lights, offsetof(Light, kind), light);
    const Int32 geometry = gather_int(lights, offsetof(Light, geometry), light);
    const Mask mesh = active & (kind == Int32(static_cast<int>(LightKind::mesh)));
    // A parallelogram's two triangles (0, 1, 2) and (0, 2, 3) over corners in circular order: the square maps without a seam.
    const Mask lower = u.x >= u.y;
    Int32 triangle = select(lower, Int32(0), Int32(1));
    Vec2<Float> b{select(lower, u.x - u.y, u.x), select(lower, u.y, u.y - u.x)};
    if (any(mesh)) {
        alignas(4 * kLanes) IntLanes chosen, index;
        NumberLanes x(u.x);
        triangle.store(chosen);
        light.store(index);
        for_lanes(mesh, [&](int i) {
            const DiscreteDistribution& triangles = lights[index[i]].triangles;
            chosen[i] = 0;
            if (triangles.size() > 1) {
                const DiscreteSample t = triangles.sample(x.x[i]);
                chosen[i] = static_cast<std::int32_t>(t.index);
                x.x[i] = t.u;
            }
        });
        triangle = Int32::load(chosen);
        const Vec2<Float> m = square_to_triangle(Vec2<Float>{x.pack(), u.y});
        b.x = select(mesh, m.x, b.x);
        b.y = select(mesh, m.y, b.y);
    }
    const GeometryRecord* records = scene.geometries.data();
    const Int32 word = gather_int(records, 0, geometry);
    const TrianglePack t = gather_triangle(scene, gather_int(records, offsetof(GeometryRecord, first), geometry) + triangle);
    const SurfacePack s = triangle_surface_pack<kEffects>(scene, t, word, active, b);

    const Vec3<Float> d = s.p - p;
    const Float d2 = dot(d, d);
    LightSamplePack out{};
    out.wi = d * (Float(1.0f) / sqrt(d2));
    const Mask lit = active & (d2 > Float(0.0f)) & (dot(out.wi, s.n) < Float(0.0f));
    out.pdf_w = select(lit, area_to_solid_angle(d2, abs(dot(s.ng, out.wi)), gather_float(lights, offsetof(Light, area), light)), Float(0.0f));
    out.radiance = texture_pack<kEffects>(scene, lights, offsetof(Light, radiance), light, lit, s.uv);
    out.target = shadow_target(s.p, s.p_error, s.ng, sqrt(d2), -d);
    return out;
}

/// As koksma::sample_light, lane by lane.
template <EffectSet kEffects>
void sample_other_lights(const Scene& scene, Mask active, Int32 light, Vec3<Float> p, Vec2<Float> u, LightSamplePack& out) {
    const VectorLanes points(p);
    const NumberLanes x(u.x), y(u.y);
    alignas(4 * kLanes) IntLanes index;
    light.store(index);
    VectorLanes wi(out.wi), radiance(out.radiance), target(out.target);
    NumberLanes pdf(out.pdf_w);
    std::uint32_t delta = 0, at_infinity = 0;
    for_lanes(active, [&](int i) {
        const LightSample s = koksma::sample_light<kEffects>(scene, scene.lights[static_cast<std::size_t>(index[i])], points[i], {x.x[i], y.x[i]});
        wi.set(i, s.wi);
        radiance.set(i, s.radiance);
        target.set(i, s.target);
        pdf.x[i] = s.pdf_w;
        delta |= static_cast<std::uint32_t>(s.delta) << i;
        at_infinity |= static_cast<std::uint32_t>(s.at_infinity) << i;
    });
    out.wi = wi.pack();
    out.radiance = radiance.pack();
    out.target = target.pack();
    out.pdf_w = pdf.pack();
    out.delta = mask_of(delta);
    out.at_infinity = mask_of(at_infinity);
}

/// As koksma::sample_light. @return  pdf_w zero in lanes without a sample
template <EffectSet kEffects>
[[nodiscard]] LightSamplePack sample_light_pack(const Scene& scene, Mask active, Int32 light, Vec3<Float> p, Vec2<Float> u) {
    const Int32 kind = gather_int(scene.lights.data(), offsetof(Light, kind), light);
    Mask triangles{};
    LightSamplePack out{};
    if constexpr (kEffects.has(Effect::area_light)) {
        triangles = active & ((kind == Int32(static_cast<int>(LightKind::mesh))) | (kind == Int32(static_cast<int>(LightKind::parallelogram))));
        if (any(triangles)) out = sample_triangle_lights<kEffects>(scene, triangles, select(triangles, light, first_lane(triangles, light)), p, u);
    }
    if (const Mask others = active & !triangles; any(others)) sample_other_lights<kEffects>(scene, others, light, p, u, out);
    return out;
}

KOKSMA_MATHS_END
