// Light sampling for packs: triangles, parallelograms and points side by side, other lights one by one.

KOKSMA_MATHS_BEGIN

/// As koksma::LightSample.
struct LightSamplePack {
    Vec3<Float> wi, radiance, target;
    Float pdf_w;
    Mask delta, at_infinity;
};

/// A scene's only light, if it is one or two triangles without textures: nothing to gather then.
struct SingleLight {
    bool usable = false, mesh = false;
    TriangleRow rows[2];
    ShadingRow shading_rows[2];
    explicit SingleLight(const Scene& scene) {
        if (scene.lights.size() != 1) return;
        const Light& light = scene.lights[0];
        const std::size_t count = light.kind == LightKind::parallelogram ? 2 : light.kind == LightKind::mesh ? light.triangles.size() : 0;
        if (count < 1 || count > 2 || light.radiance.index >= 0) return;
        const std::size_t first = scene.geometries[light.geometry].first;
        for (std::size_t t = 0; t < 2; ++t) {
            rows[t] = scene.triangle_rows[first + (t < count ? t : 0)];
            if (!scene.shading_rows.empty()) shading_rows[t] = scene.shading_rows[first + (t < count ? t : 0)];
        }
        mesh = light.kind == LightKind::mesh;
        usable = true;
    }
    [[nodiscard]] TrianglePack triangle(Int32 which) const {
        const auto of = [&](Vec3f TriangleRow::*member) { return of_triangle(which, rows[0].*member, rows[1].*member); };
        return {which,
                of(&TriangleRow::v0),
                of(&TriangleRow::v1),
                of(&TriangleRow::v2),
                of(&TriangleRow::ng),
                Int32(static_cast<std::int32_t>(rows[0].flags)),  // those that are used are the geometry's
                Int32(static_cast<std::int32_t>(rows[0].material)),
                Int32(rows[0].light)};
    }
    [[nodiscard]] ShadingPack shading(Int32 which) const {
        const auto of = [&](Vec3f ShadingRow::*member) { return of_triangle(which, shading_rows[0].*member, shading_rows[1].*member); };
        return {of(&ShadingRow::n0), of(&ShadingRow::n1), of(&ShadingRow::n2), {}, {}, {}};  // without textures: nobody asks where
    }
    [[nodiscard]] static Vec3<Float> of_triangle(Int32 which, Vec3f first, Vec3f second) {
        return select<Float>(which == Int32(1), Vec3<Float>::splat(second), Vec3<Float>::splat(first));
    }
};

/// As koksma::LightChoice.
struct LightChoicePack {
    Int32 light, triangle;
    Float probability;
    /// The only light there is.
    [[nodiscard]] static LightChoicePack only() { return {Int32(0), Int32(static_cast<std::int32_t>(kWholeLight)), Float(1.0f)}; }
};

/// As koksma::choose_light.
template <EffectSet kEffects>
[[nodiscard]] LightChoicePack choose_light_pack(const Scene& scene, Mask active, const Vec3<Float>& p, const Vec3<Float>& n, Float u) {
    LightChoicePack out = LightChoicePack::only();
    if constexpr (kEffects.has(Effect::many_lights))
        if (!scene.light_tree.empty()) {
            const VectorLanes points(p), normals(n);
            const NumberLanes numbers(u);
            NumberLanes probability(Float(0.0f));
            alignas(4 * kLanes) IntLanes light{}, triangle{};
            for_lanes(active, [&](int i) {
                const LightChoice choice = scene.light_tree.choose(points[i], normals[i], numbers.x[i]);
                light[i] = static_cast<std::int32_t>(choice.light);
                triangle[i] = static_cast<std::int32_t>(choice.triangle);
                probability.x[i] = choice.probability;
            });
            out.light = Int32::load(light);
            out.triangle = Int32::load(triangle);
            out.probability = probability.pack();
            return out;
        }
    if (scene.lights.size() > 1) {
        const DiscreteSamplePack choice = sample_pack(scene.light_choice, u);
        out.light = choice.index;
        out.probability = choice.probability;
    }
    return out;
}

/// Chooses a triangle of mesh lights, by area.
/// @param x  used, and left fresh
inline void choose_triangles(const Scene& scene, Mask mesh, Int32 light, Int32& triangle, Float& x) {
    if (scene.lights.size() == 1) {
        const DiscreteDistribution& triangles = scene.lights[0].triangles;
        triangle = Int32(0);
        if (triangles.size() > 1) {
            const DiscreteSamplePack t = sample_pack(triangles, x);
            triangle = select(mesh, t.index, triangle);
            x = select(mesh, t.u, x);
        }
        return;
    }
    alignas(4 * kLanes) IntLanes chosen, index;
    NumberLanes numbers(x);
    triangle.store(chosen);
    light.store(index);
    for_lanes(mesh, [&](int i) {
        const DiscreteDistribution& triangles = scene.lights[static_cast<std::size_t>(index[i])].triangles;
        chosen[i] = 0;
        if (triangles.size() > 1) {
            const DiscreteSample t = triangles.sample(numbers.x[i]);
            chosen[i] = static_cast<std::int32_t>(t.index);
            numbers.x[i] = t.u;
        }
    });
    triangle = Int32::load(chosen);
    x = numbers.pack();
}

/// Where a triangle was chosen and not its light: the triangle's area.
[[nodiscard]] inline Float area_of_triangles(const Scene& scene, Mask active, const LightChoicePack& choice, Float area) {
    const Mask single = active & (choice.triangle != Int32(static_cast<std::int32_t>(kWholeLight)));
    if (!any(single)) return area;
    NumberLanes areas(area);
    alignas(4 * kLanes) IntLanes light, triangle;
    choice.light.store(light);
    choice.triangle.store(triangle);
    for_lanes(single, [&](int i) { areas.x[i] = scene.lights[static_cast<std::size_t>(light[i])].area_of(static_cast<std::uint32_t>(triangle[i])); });
    return areas.pack();
}

/// As koksma::sample_light for lights made of triangles (parallelograms and meshes).
template <EffectSet kEffects>
[[nodiscard]] LightSamplePack sample_triangle_lights(const Scene& scene, const SingleLight& single, Mask active, const LightChoicePack& choice, Vec3<Float> p,
                                                     Vec2<Float> u) {
    const Int32 light = choice.light;
    const Light* lights = scene.lights.data();
    const auto are_meshes = [&] { return gather_int(lights, offsetof(Light, kind), light) == Int32(static_cast<int>(LightKind::mesh)); };
    const Mask mesh = active & (single.usable ? (single.mesh ? active : Mask{}) : are_meshes());
    // A parallelogram's two triangles (0, 1, 2) and (0, 2, 3) over corners in circular order: the square maps without a seam.
    const Mask lower = u.x >= u.y;
    Int32 triangle = select(lower, Int32(0), Int32(1));
    Vec2<Float> b{select(lower, u.x - u.y, u.x), select(lower, u.y, u.y - u.x)};
    if (any(mesh)) {
        Float x = u.x;
        const Mask whole = mesh & (choice.triangle == Int32(static_cast<std::int32_t>(kWholeLight)));
        if (any(whole)) choose_triangles(scene, whole, light, triangle, x);
        if constexpr (kEffects.has(Effect::many_lights)) triangle = select(mesh & !whole, choice.triangle, triangle);
        const Vec2<Float> m = square_to_triangle(Vec2<Float>{x, u.y});
        b.x = select(mesh, m.x, b.x);
        b.y = select(mesh, m.y, b.y);
    }
    SurfacePack s;
    Float area;
    if (single.usable) {
        triangle_surface_pack<kEffects>(single.triangle(triangle), active, b, [&] { return single.shading(triangle); }, s);
        area = Float(lights[0].area);
    } else {
        const Int32 geometry = gather_int(lights, offsetof(Light, geometry), light);
        const Int32 which = gather_int(scene.geometries.data(), offsetof(GeometryRecord, first), geometry) + triangle;
        triangle_surface_pack<kEffects>(
            load_triangles(scene, which), scene.shading_rows.empty() ? Mask{} : active, b, [&] { return load_shading<kEffects>(scene, which); }, s);
        area = gather_float(lights, offsetof(Light, area), light);
        if constexpr (kEffects.has(Effect::many_lights)) area = area_of_triangles(scene, active, choice, area);
    }
    const Vec3<Float> d = s.p - p;
    const Float d2 = dot(d, d), distance = sqrt(d2);
    LightSamplePack out;
    out.wi = d * (Float(1.0f) / distance);
    const Mask lit = active & (d2 > Float(0.0f)) & (dot(out.wi, s.n) < Float(0.0f));
    out.pdf_w = select(lit, area_to_solid_angle(d2, abs(dot(s.ng, out.wi)), area), Float(0.0f));
    out.radiance = single.usable ? Vec3<Float>::splat(lights[0].radiance.constant)
                                 : texture_pack<kEffects>(scene, lights, offsetof(Light, radiance), light, lit, s.uv);
    out.target = shadow_target(s.p, s.p_error, s.ng, distance, -d);
    out.delta = out.at_infinity = Mask{};
    return out;
}

/// As koksma::sample_light for the environment.
inline void sample_environment(const Scene& scene, Mask active, Vec2<Float> u, LightSamplePack& out) {
    Vec3<Float> d, radiance;
    Float pdf;
    if (scene.environment_map) {
        if (scene.environment_map->is_black()) return;  // pdf_w is zero there
        d = environment_direction(scene.environment_map->cells(), u);
        const EnvironmentTable table = scene.environment_map->table();
        const EnvironmentPlaceOf<Float> place = environment_place(table, d);
        const EnvironmentValueOf<Float> value = environment_at(table, place);
        radiance = value.radiance;
        pdf = value.pdf_w;
    } else {
        d = square_to_sphere(u);
        radiance = Vec3<Float>::splat(scene.lights[static_cast<std::size_t>(scene.environment_light)].radiance.constant);
        pdf = Float(0.25f * kInvPi);
    }
    assign<Float>(active, out.wi, d);
    assign<Float>(active, out.target, d);
    assign<Float>(active, out.radiance, radiance);
    out.pdf_w = select(active, pdf, out.pdf_w);
    out.at_infinity = out.at_infinity | active;
}

/// As koksma::sample_light, lane by lane.
template <EffectSet kEffects>
void sample_other_lights(const Scene& scene, Mask active, Int32 light, Vec3<Float> p, Vec2<Float> u, LightSamplePack& out) {  // never a triangle alone
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
    out.delta = out.delta | mask_of(delta);
    out.at_infinity = out.at_infinity | mask_of(at_infinity);
}

/// As koksma::sample_light. @return  pdf_w zero in lanes without a sample
template <EffectSet kEffects>
[[nodiscard]] LightSamplePack sample_light_pack(const Scene& scene, const SingleLight& single, Mask active, const LightChoicePack& choice, Vec3<Float> p,
                                                Vec2<Float> u) {
    const Int32 light = choice.light;
    const auto is_kind = [&](LightKind k) { return gather_int(scene.lights.data(), offsetof(Light, kind), light) == Int32(static_cast<int>(k)); };
    if constexpr (kEffects.has(Effect::area_light))
        if (single.usable) return sample_triangle_lights<kEffects>(scene, single, active, choice, p, u);
    LightSamplePack out{};
    Mask others = active;
    if constexpr (kEffects.has(Effect::area_light))
        if (const Mask triangles = active & (is_kind(LightKind::mesh) | is_kind(LightKind::parallelogram)); any(triangles)) {
            // The other lanes compute with the first of these lights: what they gather must be there.
            LightChoicePack readable = choice;
            readable.light = select(triangles, light, first_lane(triangles, light));
            readable.triangle = select(triangles, choice.triangle, first_lane(triangles, choice.triangle));
            out = sample_triangle_lights<kEffects>(scene, single, triangles, readable, p, u);
            others = others & !triangles;
        }
    if constexpr (kEffects.has(Effect::environment))
        if (const Mask sky = others & is_kind(LightKind::environment); any(sky)) {
            sample_environment(scene, sky, u, out);
            others = others & !sky;
        }
    if (any(others)) sample_other_lights<kEffects>(scene, others, light, p, u, out);
    return out;
}

KOKSMA_MATHS_END
