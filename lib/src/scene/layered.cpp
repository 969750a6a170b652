#include <koksma/scene/bsdf/layered_parts.h>
#include <koksma/scene/bsdf/passage.h>
#include <koksma/scene/scene.h>
#include <koksma/scene/surface.h>
#include <koksma/scene/texture_gradient.h>

namespace koksma {

namespace {

constexpr EffectSet kAll = EffectSet::all();

[[nodiscard]] Vec3f color(const Scene& scene, const TextureRef& ref, const SurfaceUv& uv) noexcept { return texture_value<kAll>(scene, ref, uv); }
/// A texture as one number: of colours the luminance.
[[nodiscard]] float number(const Scene& scene, const TextureRef& ref, const SurfaceUv& uv) noexcept {
    if (ref.index < 0) return ref.constant.x;
    return luminance(color(scene, ref, uv));
}
[[nodiscard]] float unit(float x) noexcept { return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f; }
/// Roughness below this is no longer resolved in float.
[[nodiscard]] float roughness(float alpha) noexcept { return alpha > 1e-4f ? alpha : 1e-4f; }
/// u in [low, low + width) stretched to [0, 1).
[[nodiscard]] float stretched(float u, float low, float width) noexcept {
    const float v = (u - low) / width;
    return v < kOneMinusUlp ? v : kOneMinusUlp;
}

// ---- parts that are BSDFs, textures looked up

[[nodiscard]] RoughDielectricBsdf looked_up(const Scene& scene, const RoughDielectricPart& part, const SurfaceUv& uv) noexcept {
    RoughDielectricBsdf b = part.bsdf;
    b.facets.alpha_u = roughness(number(scene, part.alpha_u, uv));
    b.facets.alpha_v = roughness(number(scene, part.alpha_v, uv));
    b.reflectance = color(scene, part.reflectance, uv);
    b.transmittance = color(scene, part.transmittance, uv);
    return b;
}
[[nodiscard]] PlasticBsdf looked_up(const Scene& scene, const PlasticPart& part, const SurfaceUv& uv) noexcept {
    PlasticBsdf b = part.bsdf;
    b.base.diffuse = color(scene, part.diffuse, uv);
    b.base.specular = color(scene, part.specular, uv);
    return b;
}

[[nodiscard]] RoughPlasticBsdf looked_up(const Scene& scene, const RoughPlasticPart& part, const SurfaceUv& uv) noexcept {
    RoughPlasticBsdf b = part.bsdf;
    b.base.diffuse = color(scene, part.diffuse, uv);
    b.base.specular = color(scene, part.specular, uv);
    return b;
}
[[nodiscard]] PrincipledBsdf looked_up(const Scene& scene, const PrincipledPart& part, const SurfaceUv& uv) noexcept {
    PrincipledBsdf b = part.bsdf;
    const auto slider = [&](const TextureRef& ref) { return unit(number(scene, ref, uv)); };
    b.base_color = color(scene, part.base_color, uv);
    b.roughness = number(scene, part.roughness, uv);
    b.anisotropic = slider(part.anisotropic);
    b.metallic = slider(part.metallic);
    b.spec_trans = slider(part.spec_trans);
    b.spec_tint = slider(part.spec_tint);
    b.sheen = slider(part.sheen);
    b.sheen_tint = slider(part.sheen_tint);
    b.flatness = slider(part.flatness);
    b.clearcoat = slider(part.clearcoat);
    b.clearcoat_gloss = slider(part.clearcoat_gloss);
    return b;
}

template <class Part>
constexpr bool kIsBsdf = requires(const Scene& scene, const Part& part) { looked_up(scene, part, SurfaceUv{}); };

[[nodiscard]] Vec3f turned_over(Vec3f w) noexcept { return {w.x, w.y, -w.z}; }

/// The same point of another side.
[[nodiscard]] LayeredPoint elsewhere(LayeredPoint at, std::uint32_t side) noexcept {
    at.side = side;
    return at;
}

// ---- other normals

/// dp/du and dp/dv at a point, in the shading frame along u.
struct Tangents {
    Vec3f u{1.0f, 0.0f, 0.0f}, v{0.0f, 1.0f, 0.0f};
};
[[nodiscard]] Tangents tangents(const Scene& scene, const LayeredPoint& at) noexcept {
    const GeometryRecord& g = scene.geometries[at.geometry];
    Vec3f du, dv;
    if (g.kind == GeometryKind::mesh) {
        const auto& index = scene.triangles[g.first + at.primitive];
        const Vec3f v0 = scene.positions[index[0]], e1 = scene.positions[index[1]] - v0, e2 = scene.positions[index[2]] - v0;
        Vec2f d1{1.0f, 0.0f}, d2{0.0f, 1.0f};
        if (g.has_uvs) {
            const Vec2f uv0 = scene.uvs[index[0]], uv1 = scene.uvs[index[1]], uv2 = scene.uvs[index[2]];
            d1 = {uv1.x - uv0.x, uv1.y - uv0.y};
            d2 = {uv2.x - uv0.x, uv2.y - uv0.y};
        }
        const float det = d1.x * d2.y - d1.y * d2.x;
        if (det == 0.0f) return {};
        du = (e1 * d2.y - e2 * d1.y) * (1.0f / det);
        dv = (e2 * d1.x - e1 * d2.x) * (1.0f / det);
    } else if (g.kind == GeometryKind::sphere) {
        const AnalyticSphere& sphere = scene.spheres[g.first];
        const SinCos phi = sincos_turns(at.uv.x), theta = sincos_turns(0.5f * at.uv.y);
        const auto radius = static_cast<float>(sphere.radius);
        du = Vec3f{-phi.sin, phi.cos, 0.0f} * (2.0f * kPi * radius * theta.sin);
        dv = Vec3f{phi.cos * theta.cos, phi.sin * theta.cos, -theta.sin} * (kPi * radius);
    } else if (g.kind == GeometryKind::cylinder) {
        const AnalyticCylinder& c = scene.cylinders[g.first];
        const SinCos phi = sincos_turns(at.uv.x);
        du = (to_float(c.t) * phi.cos - to_float(c.s) * phi.sin) * (2.0f * kPi * static_cast<float>(c.radius));
        dv = to_float(c.axis);
    } else {
        const AnalyticDisk& disk = scene.disks[g.first];
        const SinCos phi = sincos_turns(at.uv.y);
        const Vec3f s = to_float(disk.s), t = to_float(disk.t);
        du = s * phi.cos + t * phi.sin;
        dv = (t * phi.cos - s * phi.sin) * (2.0f * kPi * at.uv.x);
    }
    if (at.instance != Hit::kNone) {
        const Placement m = transfer_at(scene, scene.instances[at.instance], at.time).to_scene;
        du = to_float(vector_by(m, to_double(du)));
        dv = to_float(vector_by(m, to_double(dv)));
    }
    const Frame frame = frame_along(at.n, du);
    return {frame.to_local(du), frame.to_local(dv)};
}

[[nodiscard]] Vec3f bent_normal(const Scene& scene, const NormalMapPart& part, const LayeredPoint& at) noexcept {
    return color(scene, part.normals, at.uv) * 2.0f - Vec3f(1.0f);
}
/// Source: Blinn 1978, "Simulation of wrinkled surfaces"
[[nodiscard]] Vec3f bent_normal(const Scene& scene, const BumpMapPart& part, const LayeredPoint& at) noexcept {
    if (part.height.index < 0) return {0.0f, 0.0f, 1.0f};
    const Vec2f slope = gradient(scene.textures[static_cast<std::size_t>(part.height.index)], {at.uv.x, at.uv.y});
    Tangents t = tangents(scene, at);
    t.u.z = part.scale * slope.x;
    t.v.z = part.scale * slope.y;
    const Vec3f n = cross(t.u, t.v);
    return n.z < 0.0f ? -n : n;
}

/// The frame of the nested material within the shading frame.
template <class Part>
[[nodiscard]] Frame bent_frame(const Scene& scene, const Part& part, const LayeredPoint& at, Vec3f wo) noexcept {
    Vec3f n = bent_normal(scene, part, at);
    // Facets that look away from the camera have neighbours that look toward it.
    // Source: Schuessler et al. 2017, "Microfacet-based normal mapping for robust Monte Carlo path tracing", in the form of Mitsuba 3
    if (part.bending.flip && wo.z * dot(wo, n) <= 0.0f) n = {-n.x, -n.y, n.z};
    const float length2 = dot(n, n);
    n = length2 > 0.0f ? n * (1.0f / std::sqrt(length2)) : Vec3f{0.0f, 0.0f, 1.0f};
    const Vec3f along = Vec3f{1.0f, 0.0f, 0.0f} - n * n.x;
    const float along2 = dot(along, along);
    const Vec3f s = along2 > 0.0f ? along * (1.0f / std::sqrt(along2)) : Vec3f{0.0f, 1.0f, 0.0f};
    return {s, cross(n, s), n};
}

/// Source: Conty Estevez et al. 2019, "A microfacet-based shadowing function to solve the bump terminator problem", Ray Tracing Gems 12
[[nodiscard]] float terminator(Vec3f n, Vec3f wi) noexcept {
    const auto tan2 = [](Vec3f w) { return (w.x * w.x + w.y * w.y) / (w.z * w.z); };
    const float wide = 0.125f * tan2(n);
    return 2.0f / (1.0f + std::sqrt(1.0f + (wide < 1.0f ? wide : 1.0f) * tan2(wi)));
}

template <class Part>
constexpr bool kBends = requires(const Part& part) { part.bending; };

struct Evaluation {
    const Scene& scene;
    LayeredPoint at;
    Vec3f wo, wi;

    [[nodiscard]] BsdfValue of(std::uint32_t side) const noexcept { return eval_layered(scene, elsewhere(at, side), wo, wi); }

    template <class Part>
    BsdfValue operator()(const Part& part) const noexcept requires kIsBsdf<Part> {
        return eval_bsdf(looked_up(scene, part, at.uv), wo, wi);
    }
    template <class Part>
    BsdfValue operator()(const Part& part) const noexcept requires kBends<Part> {
        const Frame frame = bent_frame(scene, part, at, wo);
        const Vec3f to = frame.to_local(wi);
        if (!(wi.z * to.z > 0.0f)) return {};
        const BsdfValue v = eval_layered(scene, elsewhere(at, part.bending.nested), frame.to_local(wo), to);
        return part.bending.shadow ? BsdfValue{v.f_cos * terminator(frame.n, wi), v.pdf_w} : v;
    }
    BsdfValue operator()(const BlendPart& part) const noexcept {
        const float w = unit(number(scene, part.weight, at.uv));
        const BsdfValue a = of(part.first), b = of(part.second);
        return {a.f_cos * (1.0f - w) + b.f_cos * w, a.pdf_w * (1.0f - w) + b.pdf_w * w};
    }
    BsdfValue operator()(const MaskPart& part) const noexcept {
        const float opacity = unit(number(scene, part.opacity, at.uv));
        const BsdfValue v = of(part.nested);
        return {v.f_cos * opacity, v.pdf_w * opacity};
    }
    BsdfValue operator()(const NullPart&) const noexcept { return {}; }
    BsdfValue operator()(const TwoSidedPart& part) const noexcept {
        if (wo.z > 0.0f) return of(part.front);
        return eval_layered(scene, elsewhere(at, part.back), turned_over(wo), turned_over(wi));
    }
};

struct Sampling {
    const Scene& scene;
    LayeredPoint at;
    Vec3f wo;
    float u_lobe;
    Vec2f u;
    bool stopped = false;  ///< not what passes straight on

    /// Of another side. @param v  its number for the choice of a lobe
    [[nodiscard]] BsdfSample of(std::uint32_t side, float v) const noexcept {
        const LayeredPoint there = elsewhere(at, side);
        return stopped ? sample_stopped(scene, there, wo, v, u) : sample_layered(scene, there, wo, v, u);
    }

    template <class Part>
    BsdfSample operator()(const Part& part) const noexcept requires kIsBsdf<Part> {
        return sample_bsdf(looked_up(scene, part, at.uv), wo, u_lobe, u);
    }
    template <class Part>
    BsdfSample operator()(const Part& part) const noexcept requires kBends<Part> {
        const Frame frame = bent_frame(scene, part, at, wo);
        BsdfSample s = sample_layered(scene, elsewhere(at, part.bending.nested), frame.to_local(wo), u_lobe, u);
        const Vec3f wi = frame.to_world(s.wi);
        if (!(s.pdf_w > 0.0f) || !(s.wi.z * wi.z > 0.0f)) return {};
        s.wi = wi;
        if (part.bending.shadow) s.weight = s.weight * terminator(frame.n, wi);
        return s;
    }
    BsdfSample operator()(const BlendPart& part) const noexcept {
        const float w = unit(number(scene, part.weight, at.uv));
        const float chance = stopped ? stopped_share(part, w) : w;  // of the second
        const bool second = u_lobe < chance;
        const float probability = second ? w : 1.0f - w;
        BsdfSample s = of(second ? part.second : part.first, second ? stretched(u_lobe, 0.0f, chance) : stretched(u_lobe, chance, 1.0f - chance));
        if (!(s.pdf_w > 0.0f)) return {};
        if (s.delta) {
            s.pdf_w *= probability;
            return s;
        }
        // The other material may have made the same direction.
        const BsdfValue other = eval_layered(scene, elsewhere(at, second ? part.first : part.second), wo, s.wi);
        const float own = s.pdf_w * probability, all = own + other.pdf_w * (1.0f - probability);
        s.weight = s.weight * (own / all) + other.f_cos * ((1.0f - probability) / all);
        s.pdf_w = all;
        return s;
    }
    /// Share of the second among the samples of a blend that do not pass.
    [[nodiscard]] float stopped_share(const BlendPart& part, float w) const noexcept {
        const float a = (1.0f - w) * (1.0f - passage_at(scene, elsewhere(at, part.first), wo).probability);
        const float b = w * (1.0f - passage_at(scene, elsewhere(at, part.second), wo).probability);
        return a + b > 0.0f ? b / (a + b) : w;
    }
    BsdfSample operator()(const MaskPart& part) const noexcept {
        const float opacity = unit(number(scene, part.opacity, at.uv));
        if (!stopped && !(u_lobe < opacity)) return {-wo, Vec3f(1.0f), 1.0f - opacity, 1.0f, true};
        BsdfSample s = of(part.nested, stopped ? u_lobe : stretched(u_lobe, 0.0f, opacity));
        s.pdf_w *= opacity;
        return s;
    }
    BsdfSample operator()(const NullPart&) const noexcept { return {-wo, Vec3f(1.0f), 1.0f, 1.0f, true}; }
    BsdfSample operator()(const TwoSidedPart& part) const noexcept {
        if (wo.z > 0.0f) return sample_layered(scene, elsewhere(at, part.front), wo, u_lobe, u);
        BsdfSample s = sample_layered(scene, elsewhere(at, part.back), turned_over(wo), u_lobe, u);
        s.wi = turned_over(s.wi);
        return s;
    }
};

}  // namespace

BsdfValue eval_layered(const Scene& scene, const LayeredPoint& at, Vec3f wo, Vec3f wi) noexcept {
    const MaterialSide& side = scene.sides[at.side];
    if (side.layered < 0) return eval_bsdf<kAll>(bsdf_of<kAll>(scene, side, at.uv), wo, wi);
    return std::visit(Evaluation{scene, at, wo, wi}, scene.layered->parts[static_cast<std::size_t>(side.layered)]);
}

BsdfSample sample_layered(const Scene& scene, const LayeredPoint& at, Vec3f wo, float u_lobe, Vec2f u) noexcept {
    const MaterialSide& side = scene.sides[at.side];
    if (side.layered < 0) return sample_bsdf<kAll>(bsdf_of<kAll>(scene, side, at.uv), wo, u_lobe, u);
    return std::visit(Sampling{scene, at, wo, u_lobe, u}, scene.layered->parts[static_cast<std::size_t>(side.layered)]);
}

BsdfSample sample_stopped(const Scene& scene, const LayeredPoint& at, Vec3f wo, float u_lobe, Vec2f u) noexcept {
    const MaterialSide& side = scene.sides[at.side];
    // Thin glass reflects below its reflectance.
    if (side.layered < 0) return sample_bsdf<kAll>(bsdf_of<kAll>(scene, side, at.uv), wo, side.kind == BsdfKind::thin_dielectric ? 0.0f : u_lobe, u);
    return std::visit(Sampling{scene, at, wo, u_lobe, u, true}, scene.layered->parts[static_cast<std::size_t>(side.layered)]);
}

}  // namespace koksma
