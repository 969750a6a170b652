// Surface points and BSDFs of as many paths as a pack has lanes. Triangles in packs, other shapes one by one.

KOKSMA_MATHS_BEGIN

/// As koksma::SurfaceUv.
struct SurfaceUvPack {
    Float x, y;
    Int32 triangle;
    Vec2<Float> barycentrics;
};
/// The same, lane by lane.
template <EffectSet kEffects>
class SurfaceUvLanes {
public:
    explicit SurfaceUvLanes(const SurfaceUvPack& uv) : x_(uv.x), y_(uv.y) {
        if constexpr (kEffects.has(Effect::mesh_attribute)) {
            uv.triangle.store(triangle_);
            uv.barycentrics.x.store(b1_.x);
            uv.barycentrics.y.store(b2_.x);
        }
    }
    [[nodiscard]] SurfaceUv operator[](int lane) const {
        SurfaceUv uv{x_.x[lane], y_.x[lane]};
        if constexpr (kEffects.has(Effect::mesh_attribute)) {
            uv.triangle = static_cast<std::uint32_t>(triangle_[lane]);
            uv.barycentrics = {b1_.x[lane], b2_.x[lane]};
        }
        return uv;
    }
    void set(int lane, const SurfaceUv& uv) {
        x_.x[lane] = uv.x;
        y_.x[lane] = uv.y;
        if constexpr (kEffects.has(Effect::mesh_attribute)) {
            triangle_[lane] = static_cast<std::int32_t>(uv.triangle);
            b1_.x[lane] = uv.barycentrics.x;
            b2_.x[lane] = uv.barycentrics.y;
        }
    }
    [[nodiscard]] SurfaceUvPack pack() const {
        SurfaceUvPack uv{x_.pack(), y_.pack(), Int32{}, {}};
        if constexpr (kEffects.has(Effect::mesh_attribute)) {
            uv.triangle = Int32::load(triangle_);
            uv.barycentrics = {b1_.pack(), b2_.pack()};
        }
        return uv;
    }

private:
    NumberLanes x_, y_, b1_, b2_;
    alignas(4 * kLanes) IntLanes triangle_;
};

/// As koksma::Surface, with what its geometry says.
struct SurfacePack {
    Vec3<Float> p, p_error, ng, n, dpdu;
    SurfaceUvPack uv;
    Int32 geometry, primitive, material, light;
    Int32 instance;  ///< with the ray's time, only with the effect instancing
    Float time;
};

/// One bit of flags, one in each byte.
template <int byte>
[[nodiscard]] Mask flag(Int32 flags) {
    return (flags & Int32(1 << (8 * byte))) != Int32(0);
}

/// As koksma::TriangleRow.
struct TrianglePack {
    Int32 which;
    Vec3<Float> v0, v1, v2, ng;
    Int32 flags, material, light;
};
[[nodiscard]] inline TrianglePack load_triangles(const Scene& scene, Int32 which) {
    constexpr int kWords = sizeof(TriangleRow) / 4;
    Float w[kWords];
    load_rows(reinterpret_cast<const float*>(scene.triangle_rows.data()), kWords, which, w);
    static_assert(offsetof(TriangleRow, v1) == 12 && offsetof(TriangleRow, v2) == 24 && offsetof(TriangleRow, ng) == 36 &&
                  offsetof(TriangleRow, flags) == 48 && offsetof(TriangleRow, material) == 52 && offsetof(TriangleRow, light) == 56);
    return {which, {w[0], w[1], w[2]}, {w[3], w[4], w[5]}, {w[6], w[7], w[8]}, {w[9], w[10], w[11]}, bits_of(w[12]), bits_of(w[13]), bits_of(w[14])};
}

/// As koksma::ShadingRow.
struct ShadingPack {
    Vec3<Float> n0, n1, n2;
    Vec2<Float> uv0, uv1, uv2;
};
template <EffectSet kEffects>
[[nodiscard]] ShadingPack load_shading(const Scene& scene, Int32 which) {
    constexpr bool kUvs = kEffects.has(Effect::texture) || kEffects.has(Effect::anisotropic);
    Float w[kUvs ? 16 : 12];
    load_rows(reinterpret_cast<const float*>(scene.shading_rows.data()), sizeof(ShadingRow) / 4, which, w);
    static_assert(offsetof(ShadingRow, n1) == 12 && offsetof(ShadingRow, n2) == 24 && offsetof(ShadingRow, uv0) == 36 && offsetof(ShadingRow, uv2) == 52);
    ShadingPack s{{w[0], w[1], w[2]}, {w[3], w[4], w[5]}, {w[6], w[7], w[8]}, {}, {}, {}};
    if constexpr (kUvs) s.uv0 = {w[9], w[10]}, s.uv1 = {w[11], w[12]}, s.uv2 = {w[13], w[14]};
    return s;
}

// The first byte of a record's first word is its kind: so it is read below.
static_assert(offsetof(GeometryRecord, kind) == 0 && sizeof(GeometryKind) == 1 && std::endian::native == std::endian::little);

/// Of the lanes that met a mesh. @param hit  lanes that met something
[[nodiscard]] inline Mask met_mesh(const Scene& scene, Mask hit, Int32 geometry, Int32 primitive, Int32& triangle) {
    const GeometryRecord* records = scene.geometries.data();
    const Int32 g = select(hit, geometry, Int32(0));
    triangle = gather_int(records, offsetof(GeometryRecord, first), g) + primitive;
    return hit & ((gather_int(records, 0, g) & Int32(0xff)) == Int32(static_cast<int>(GeometryKind::mesh)));
}
/// Has fetched into the cache what surface_pack will read.
inline void prefetch_triangles(const Scene& scene, Mask hit, Int32 geometry, Int32 primitive) {
    Int32 triangle;
    const Mask mesh = met_mesh(scene, hit, geometry, primitive, triangle);
    prefetch(scene.triangle_rows.data(), mesh, triangle);
    if (!scene.shading_rows.empty()) prefetch(scene.shading_rows.data(), mesh, triangle);
}

/// @param b        barycentrics
/// @param shading  called for what the vertices carry, if any lane needs it
/// @param s        gets all but what its geometry says
template <EffectSet kEffects, class Shading>
void triangle_surface_pack(const TrianglePack& t, Mask active, Vec2<Float> b, const Shading& shading, SurfacePack& s) {
    const TrianglePointOf<Float> point = triangle_point(t.v0, t.v1, t.v2, b);
    s.p = point.p;
    s.p_error = point.p_error;
    s.ng = s.n = t.ng;
    if constexpr (kEffects.has(Effect::shading_normals))
        if (const Mask m = active & flag<2>(t.flags); any(m)) {
            const ShadingPack vertices = shading();
            assign<Float>(m, s.n, interpolated_normal(vertices.n0, vertices.n1, vertices.n2, point.b0, b, s.ng));
        }
    if (const Mask m = flag<1>(t.flags); any(m)) {
        assign<Float>(m, s.ng, -s.ng);
        assign<Float>(m, s.n, -s.n);
    }
    if constexpr (kEffects.has(Effect::texture) || kEffects.has(Effect::anisotropic)) {
        s.uv.x = b.x;
        s.uv.y = b.y;
        s.dpdu = Vec3<Float>(Float(0.0f));
        if (const Mask m = active & flag<3>(t.flags); any(m)) {
            const ShadingPack v = shading();
            s.uv.x = select(m, v.uv0.x * point.b0 + v.uv1.x * b.x + v.uv2.x * b.y, s.uv.x);
            s.uv.y = select(m, v.uv0.y * point.b0 + v.uv1.y * b.x + v.uv2.y * b.y, s.uv.y);
            if constexpr (kEffects.has(Effect::anisotropic)) assign<Float>(m, s.dpdu, direction_of_u(t.v0, t.v1, t.v2, v.uv0, v.uv1, v.uv2));
        }
    }
    if constexpr (kEffects.has(Effect::mesh_attribute)) {
        s.uv.triangle = t.which;
        s.uv.barycentrics = b;
    }
}

/// Puts a point that was computed alone into its lane.
template <EffectSet kEffects>
struct SurfaceLanes {
    VectorLanes p, p_error, ng, n, dpdu;
    SurfaceUvLanes<kEffects> uv;
    explicit SurfaceLanes(const SurfacePack& s) : p(s.p), p_error(s.p_error), ng(s.ng), n(s.n), dpdu(s.dpdu), uv(s.uv) {}
    void set(int lane, const Surface& s) {
        p.set(lane, s.p);
        p_error.set(lane, s.p_error);
        ng.set(lane, s.ng);
        n.set(lane, s.n);
        dpdu.set(lane, s.dpdu);
        uv.set(lane, s.uv);
    }
    void get(SurfacePack& s) const {
        s.p = p.pack();
        s.p_error = p_error.pack();
        s.ng = ng.pack();
        s.n = n.pack();
        s.dpdu = dpdu.pack();
        s.uv = uv.pack();
    }
};

inline void refine(const TrianglePack& t, const Vec3<Float>& o, const Vec3<Float>& d, Mask coarse, SurfacePack& s) {
    const VectorLanes v0(t.v0), v1(t.v1), v2(t.v2), origins(o), directions(d);
    VectorLanes p(s.p), p_error(s.p_error);
    for_lanes(coarse, [&](int i) {
        const RefinedPoint r = refined_point(v0[i], v1[i], v2[i], origins[i], directions[i], {p[i], p_error[i]});
        p.set(i, r.p);
        p_error.set(i, r.p_error);
    });
    s.p = p.pack();
    s.p_error = p_error.pack();
}

/// @param active     lanes that met something
/// @param geometry, primitive, instance, time  of those lanes; anything in others
template <EffectSet kEffects>
[[nodiscard]] SurfacePack surface_pack(const Scene& scene, Mask active, Vec3<Float> o, Vec3<Float> d, Int32 geometry, Int32 primitive,
                                       [[maybe_unused]] Int32 instance, [[maybe_unused]] Float time) {
    constexpr bool kAlone =
        kEffects.has(Effect::analytic_shape) || kEffects.has(Effect::instancing);  // some points are computed one by one
    const GeometryRecord* records = scene.geometries.data();
    const Int32 g = select(active, geometry, Int32(0));
    Mask meshes = active;
    if constexpr (kEffects.has(Effect::analytic_shape))
        meshes = active & ((gather_int(records, 0, g) & Int32(0xff)) == Int32(static_cast<int>(GeometryKind::mesh)));
    if constexpr (kEffects.has(Effect::instancing)) meshes = meshes & (instance == Int32(-1));
    SurfacePack s;
    if (!kAlone || any(meshes)) {
        const Int32 triangle = select(meshes, gather_int(records, offsetof(GeometryRecord, first), g) + primitive, Int32(0));
        const TrianglePack t = load_triangles(scene, triangle);
        triangle_surface_pack<kEffects>(
            t, scene.shading_rows.empty() ? Mask{} : meshes, barycentrics(t.v0, t.v1, t.v2, o, d), [&] { return load_shading<kEffects>(scene, triangle); }, s);
        if (const Mask coarse = meshes & (is_coarse(s.p, s.p_error, o) | flag<0>(t.flags)); any(coarse)) refine(t, o, d, coarse, s);
        s.material = t.material;
        s.light = t.light;
    }
    if constexpr (kAlone)
        if (const Mask others = active & !meshes; any(others)) {
            SurfaceLanes<kEffects> lanes(s);
            const VectorLanes origins(o), directions(d);
            const NumberLanes times(time);
            alignas(4 * kLanes) IntLanes geometries, primitives, instances;
            g.store(geometries);
            primitive.store(primitives);
            instance.store(instances);
            for_lanes(others, [&](int i) {
                const Ray ray{.o = origins[i], .d = directions[i], .time = times.x[i]};
                const Hit hit{static_cast<std::uint32_t>(geometries[i]), static_cast<std::uint32_t>(primitives[i]),
                              static_cast<std::uint32_t>(instances[i])};
                lanes.set(i, koksma::surface_at<kEffects>(scene, ray, hit));
            });
            lanes.get(s);
            s.material = gather_int(records, offsetof(GeometryRecord, material), g);
            s.light = gather_int(records, offsetof(GeometryRecord, light), g);
        }
    if constexpr (kEffects.has(Effect::instancing)) {
        s.instance = instance;
        s.time = time;
    }
    s.geometry = g;
    s.primitive = primitive;
    return s;
}

/// The value of a texture, whose reference is a member of the records that an index selects.
template <EffectSet kEffects, class Record>
[[nodiscard]] Vec3<Float> texture_pack(const Scene& scene, const Record* records, std::size_t offset, Int32 index, Mask active,
                                      const SurfaceUvPack& uv) {
    Vec3<Float> value = gather_vector(records, offset + offsetof(TextureRef, constant), index);
    if constexpr (kEffects.has(Effect::texture)) {
        const Int32 texture = gather_int(records, offset + offsetof(TextureRef, index), index);
        if (const Mask m = active & (texture >= Int32(0)); any(m)) {
            VectorLanes lanes(value);
            const SurfaceUvLanes<kEffects> places(uv);
            alignas(4 * kLanes) IntLanes textures;
            texture.store(textures);
            for_lanes(m, [&](int i) { lanes.set(i, koksma::texture_value<kEffects>(scene, TextureRef{Vec3f{}, textures[i]}, places[i])); });
            value = lanes.pack();
        }
    }
    return value;
}

struct LocalBsdfPack {
    BsdfOf<Float> bsdf;
    FrameOf<Float> frame;
    Int32 side, geometry, primitive, instance;  ///< where a layered material is asked, with
    Float time;
    SurfaceUvPack uv;
    Vec3<Float> n;
};

/// As koksma::bsdf_at.
template <EffectSet kEffects>
[[nodiscard]] LocalBsdfPack bsdf_pack(const Scene& scene, const SurfacePack& s, Mask active, Vec3<Float> wo) {
    const MaterialSides* materials = scene.materials.data();
    static_assert(sizeof(MaterialSides) == 12 && offsetof(MaterialSides, two_sided) == 8 && offsetof(MaterialSides, anisotropic) == 9);
    LocalBsdfPack out;
    out.frame = FrameOf<Float>::from_normal(s.n);
    Int32 side = gather_int(materials, offsetof(MaterialSides, front), s.material), flags{};
    if constexpr (kEffects.has(Effect::two_sided) || kEffects.has(Effect::anisotropic))
        flags = gather_int(materials, offsetof(MaterialSides, two_sided), s.material);
    if constexpr (kEffects.has(Effect::anisotropic))
        if (const Mask m = flag<1>(flags); any(m & active)) {
            const FrameOf<Float> along = frame_along(s.n, s.dpdu);
            assign<Float>(m, out.frame.s, along.s);
            assign<Float>(m, out.frame.t, along.t);
        }
    if constexpr (kEffects.has(Effect::two_sided))
        if (const Mask m = flag<0>(flags) & (dot(wo, s.n) < Float(0.0f)); any(m & active)) {
            side = select(m, gather_int(materials, offsetof(MaterialSides, back), s.material), side);
            assign<Float>(m, out.frame.n, -out.frame.n);
            assign<Float>(m, out.frame.t, -out.frame.t);
        }
    const MaterialSide* sides = scene.sides.data();
    static_assert(offsetof(MaterialSide, kind) == 0 && offsetof(MaterialSide, perfect) == 4 && offsetof(MaterialSide, ggx) == 5);
    out.bsdf.kind = gather_int(sides, 0, side);
    if constexpr (kEffects.has(Effect::layered)) {
        out.side = side;
        out.geometry = s.geometry;
        out.primitive = s.primitive;
        out.instance = Int32(-1);
        out.time = Float(0.0f);
        if constexpr (kEffects.has(Effect::instancing)) {
            out.instance = s.instance;
            out.time = s.time;
        }
        out.uv = s.uv;
        out.n = s.n;
    }
    out.bsdf.reflectance = texture_pack<kEffects>(scene, sides, offsetof(MaterialSide, reflectance), side, active, s.uv);
    if constexpr (kEffects.has(Effect::glossy) || kEffects.has(Effect::specular) || kEffects.has(Effect::dielectric)) {
        if (all(out.bsdf.kind == Int32(static_cast<int>(BsdfKind::diffuse)) | !active)) return out;
        const Int32 side_flags = gather_int(sides, offsetof(MaterialSide, perfect), side);
        out.bsdf.perfect = flag<0>(side_flags);
        out.bsdf.facets.ggx = flag<1>(side_flags);
        out.bsdf.transmittance = gather_vector(sides, offsetof(MaterialSide, transmittance), side);
        out.bsdf.eta = gather_vector(sides, offsetof(MaterialSide, eta), side);
        out.bsdf.k = gather_vector(sides, offsetof(MaterialSide, k), side);
    }
    if constexpr (kEffects.has(Effect::glossy)) {
        const Mask m = active & (out.bsdf.kind == Int32(static_cast<int>(BsdfKind::rough_conductor)));
        const auto alpha = [&](std::size_t offset) {
            const Float a = texture_pack<kEffects>(scene, sides, offset, side, m, s.uv).x;
            return select(a > Float(1e-4f), a, Float(1e-4f));
        };
        if (any(m)) {
            out.bsdf.facets.alpha_u = alpha(offsetof(MaterialSide, alpha_u));
            out.bsdf.facets.alpha_v = alpha(offsetof(MaterialSide, alpha_v));
        }
    }
    return out;
}

KOKSMA_MATHS_END
