#include <koksma/sampling/error.h>

#include "compile.h"

#include <koksma/scene/bsdf/layered_parts.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <tuple>
#include <utility>

namespace koksma::detail {

namespace {

/// True if two textures are equal everywhere; false may also mean that nobody looked closely.
bool is_same(const Texture& a, const Texture& b) {
    if (a.index() != b.index()) return false;
    if (const auto* constant = std::get_if<Rgb>(&a)) return *constant == std::get<Rgb>(b);
    if (const auto* x = std::get_if<BitmapTexture>(&a)) {
        const auto& y = std::get<BitmapTexture>(b);
        return x->image == y.image && x->filter == y.filter && x->wrap == y.wrap && x->to_uv == y.to_uv;
    }
    if (const auto* x = std::get_if<MeshAttributeTexture>(&a)) {
        const auto& y = std::get<MeshAttributeTexture>(b);
        return x->name == y.name && x->scale == y.scale;
    }
    const auto &x = std::get<CheckerboardTexture>(a), &y = std::get<CheckerboardTexture>(b);
    return x.color0 == y.color0 && x.color1 == y.color1 && x.to_uv == y.to_uv;
}

bool is_zero(const Texture& t) { return is_same(t, Rgb(0.0f)); }

std::uint32_t add_nested(Scene& scene, std::vector<LayeredPart>& parts, const Material& material, bool& anisotropic);

/// Mean of the channels: for sampling weights, so never 0 where the texture may not be.
float mean_of(const Texture& t) {
    if (std::holds_alternative<MeshAttributeTexture>(t)) return 0.5f;
    const Vec3f m = mean(t);
    return (m.x + m.y + m.z) / 3.0f;
}

/// True where a part of the light passes straight on.
bool lets_pass(const Material& m) {
    if (const auto* blend = std::get_if<Blend>(&m.front)) return lets_pass(blend->nested.at(0)) || lets_pass(blend->nested.at(1));
    return std::holds_alternative<Mask>(m.front) || std::holds_alternative<Null>(m.front) || std::holds_alternative<ThinDielectric>(m.front);
}

struct SideCompiler {
    Scene& scene;
    std::vector<LayeredPart>& parts;
    MaterialSide side{};
    bool anisotropic = false;

    void conductor(const Conductor& c) {
        side.perfect = c.perfect;
        side.eta = c.eta;
        side.k = c.k;
        side.reflectance.constant = c.specular_reflectance;
    }
    /// The frame follows the UVs.
    void along_u() {
        anisotropic = true;
        scene.effects |= {Effect::anisotropic};
    }
    /// @return  references to both
    std::pair<TextureRef, TextureRef> roughness(const Texture& alpha_u, const Texture& alpha_v) {
        if (!is_same(alpha_u, alpha_v)) along_u();
        return {texture_ref(scene, alpha_u), texture_ref(scene, alpha_v)};
    }
    void layered(LayeredPart part, BsdfKind kind, EffectSet effects) {
        side.kind = kind;
        side.layered = static_cast<std::int32_t>(parts.size());
        parts.push_back(std::move(part));
        scene.effects |= effects | EffectSet{Effect::layered};
        if (!std::holds_alternative<NullPart>(parts.back())) scene.effects |= {Effect::lobe};
    }
    [[nodiscard]] BsdfKind kind_of(std::uint32_t nested) const { return scene.sides[nested].kind; }
    [[nodiscard]] bool is_delta(std::uint32_t nested) const {
        return kind_of(nested) == BsdfKind::dielectric || kind_of(nested) == BsdfKind::thin_dielectric || kind_of(nested) == BsdfKind::conductor ||
               kind_of(nested) == BsdfKind::layered_delta;
    }
    /// Of a material made of others.
    [[nodiscard]] BsdfKind combined(std::initializer_list<std::uint32_t> nested) const {
        BsdfKind kind = BsdfKind::layered_delta;
        for (const std::uint32_t p : nested) {
            if (kind_of(p) == BsdfKind::layered_through) return BsdfKind::layered_through;
            if (!is_delta(p)) kind = BsdfKind::layered;
        }
        return kind;
    }

    void operator()(const Diffuse& d) {
        side.kind = BsdfKind::diffuse;
        side.reflectance = texture_ref(scene, d.reflectance);
        scene.effects |= {Effect::diffuse};
    }
    template <class Smooth>
    void smooth_dielectric(const Smooth& d, BsdfKind kind) {
        side.kind = kind;
        side.eta = Vec3f(d.int_ior / d.ext_ior);
        side.reflectance.constant = d.specular_reflectance;
        side.transmittance = d.specular_transmittance;
        scene.effects |= {Effect::dielectric, Effect::lobe};
        if (kind == BsdfKind::thin_dielectric) scene.effects |= {Effect::null_boundary, Effect::mask};
    }
    void operator()(const Dielectric& d) { smooth_dielectric(d, BsdfKind::dielectric); }
    void operator()(const ThinDielectric& d) { smooth_dielectric(d, BsdfKind::thin_dielectric); }
    void operator()(const Conductor& c) {
        side.kind = BsdfKind::conductor;
        conductor(c);
        scene.effects |= {Effect::specular};
    }
    void operator()(const RoughConductor& c) {
        side.kind = BsdfKind::rough_conductor;
        conductor(c.base);
        side.ggx = c.distribution == Facets::ggx;
        std::tie(side.alpha_u, side.alpha_v) = roughness(c.alpha_u, c.alpha_v);
        scene.effects |= {Effect::glossy};
    }
    void operator()(const RoughDielectric& r) {
        RoughDielectricPart p;
        p.bsdf.eta = r.int_ior / r.ext_ior;
        p.bsdf.facets.ggx = r.distribution == Facets::ggx;
        std::tie(p.alpha_u, p.alpha_v) = roughness(r.alpha_u, r.alpha_v);
        p.reflectance = texture_ref(scene, r.specular_reflectance);
        p.transmittance = texture_ref(scene, r.specular_transmittance);
        layered(p, BsdfKind::layered_through, {Effect::glossy, Effect::dielectric});
    }
    template <class From>
    [[nodiscard]] static PlasticBase plastic_base(const From& p) {
        PlasticBase b;
        b.eta = p.int_ior / p.ext_ior;
        b.nonlinear = p.nonlinear;
        const float diffuse = mean_of(p.diffuse_reflectance), specular = mean_of(p.specular_reflectance);
        b.specular_share = diffuse + specular > 0.0f ? specular / (diffuse + specular) : 0.5f;
        return b;
    }
    void operator()(const Plastic& p) {
        PlasticPart part;
        part.bsdf.base = plastic_base(p);
        part.bsdf.base.inner_reflectance = diffuse_fresnel_reflectance(1.0f / part.bsdf.base.eta);
        part.diffuse = texture_ref(scene, p.diffuse_reflectance);
        part.specular = texture_ref(scene, p.specular_reflectance);
        layered(part, BsdfKind::layered, {Effect::diffuse, Effect::specular});
    }
    void operator()(const RoughPlastic& p) {
        RoughPlasticPart part;
        part.bsdf.base = plastic_base(p);
        const float alpha = std::max(p.alpha, 1e-4f);
        part.bsdf.facets = {alpha, alpha, p.distribution == Facets::ggx};
        tabulate(part.bsdf);
        part.diffuse = texture_ref(scene, p.diffuse_reflectance);
        part.specular = texture_ref(scene, p.specular_reflectance);
        layered(part, BsdfKind::layered, {Effect::glossy});
    }
    void operator()(const Principled& p) {
        PrincipledPart part;
        const bool transmits = !is_zero(p.spec_trans);
        part.bsdf.eta = p.eta;
        part.bsdf.has_spec_trans = transmits;
        part.bsdf.specular_rate = p.main_specular_sampling_rate;
        part.bsdf.clearcoat_rate = p.clearcoat_sampling_rate;
        part.bsdf.diffuse_rate = p.diffuse_reflectance_sampling_rate;
        const std::pair<TextureRef*, const Texture*> textures[] = {
            {&part.base_color, &p.base_color}, {&part.roughness, &p.roughness},   {&part.anisotropic, &p.anisotropic}, {&part.metallic, &p.metallic},
            {&part.spec_trans, &p.spec_trans}, {&part.spec_tint, &p.spec_tint},   {&part.sheen, &p.sheen},             {&part.sheen_tint, &p.sheen_tint},
            {&part.flatness, &p.flatness},     {&part.clearcoat, &p.clearcoat},   {&part.clearcoat_gloss, &p.clearcoat_gloss}};
        for (const auto& [ref, texture] : textures) *ref = texture_ref(scene, *texture);
        if (!is_zero(p.anisotropic)) along_u();
        if (transmits)
            layered(part, BsdfKind::layered_through, {Effect::glossy, Effect::dielectric});
        else
            layered(part, BsdfKind::layered, {Effect::glossy});
    }
    template <class Part>
    void bent(Part part, const Bending& b) {
        part.bending = {b.flip_invalid_normals, b.use_shadowing_function, add_nested(scene, parts, b.nested.at(0), anisotropic)};
        along_u();
        layered(part, combined({part.bending.nested}), {});
    }
    void operator()(const NormalMap& m) {
        NormalMapPart part;
        part.normals = texture_ref(scene, m.normals);
        bent(part, m.bending);
    }
    void operator()(const BumpMap& m) {
        BumpMapPart part;
        part.height = texture_ref(scene, m.height);
        part.scale = m.scale;
        bent(part, m.bending);
    }
    void operator()(const Blend& b) {
        BlendPart part;
        part.weight = texture_ref(scene, b.weight);
        part.first = add_nested(scene, parts, b.nested.at(0), anisotropic);
        part.second = add_nested(scene, parts, b.nested.at(1), anisotropic);
        layered(part, combined({part.first, part.second}), {});
        if (lets_pass(b.nested[0]) || lets_pass(b.nested[1])) scene.effects |= {Effect::mask};
    }
    void operator()(const Mask& m) {
        MaskPart part;
        part.opacity = texture_ref(scene, m.opacity);
        part.nested = add_nested(scene, parts, m.nested.at(0), anisotropic);
        layered(part, combined({part.nested}), {Effect::specular, Effect::null_boundary, Effect::mask});
    }
    void operator()(const Null&) { layered(NullPart{}, BsdfKind::layered_delta, {Effect::specular, Effect::null_boundary}); }
};

std::uint32_t add_side(Scene& scene, std::vector<LayeredPart>& parts, const OneSidedMaterial& material, bool& anisotropic) {
    SideCompiler compiler{scene, parts};
    std::visit(compiler, material);
    anisotropic = anisotropic || compiler.anisotropic;
    scene.sides.push_back(compiler.side);
    return static_cast<std::uint32_t>(scene.sides.size() - 1);
}

/// A layered material seen from both sides.
std::uint32_t add_two_sided(Scene& scene, std::vector<LayeredPart>& parts, std::uint32_t front, std::uint32_t back) {
    SideCompiler compiler{scene, parts};
    compiler.layered(TwoSidedPart{front, back}, compiler.combined({front, back}), {});
    scene.sides.push_back(compiler.side);
    return static_cast<std::uint32_t>(scene.sides.size() - 1);
}

std::uint32_t add_nested(Scene& scene, std::vector<LayeredPart>& parts, const Material& material, bool& anisotropic) {
    const std::uint32_t front = add_side(scene, parts, material.front, anisotropic);
    if (!material.two_sided) return front;
    return add_two_sided(scene, parts, front, material.back ? add_side(scene, parts, *material.back, anisotropic) : front);
}

/// @throws Error for values that are no colour, with their place in the mesh
void check_values(const MeshAttribute& attribute, const MeshAttributeTexture& use, const Shape& shape) {
    for (std::size_t i = 0; i < attribute.values.size(); ++i) {
        const Rgb v = attribute.values[i] * use.scale;
        const auto good = [&](float x) { return std::isfinite(x) && x >= 0.0f && (x <= 1.0f || !use.reflectance); };
        if (!good(v.r) || !good(v.g) || !good(v.b))
            throw Error(shape.where.text() + ": '" + attribute.name + "' of " + (attribute.per_face() ? "triangle " : "vertex ") + std::to_string(i) + " is " +
                        std::to_string(v.r) + " " + std::to_string(v.g) + " " + std::to_string(v.b) +
                        (use.reflectance ? "; reflectances must be in [0, 1]" : "; it must be finite and not negative"));
    }
}

/// @throws Error for a shape whose mesh lacks an attribute that its material looks up, or has one of values without meaning
void check_attributes(const Scene& scene, std::uint32_t material, std::size_t first_texture) {
    for (std::size_t t = first_texture; t < scene.textures.size(); ++t) {
        const auto* wanted = std::get_if<MeshAttributeTexture>(&scene.textures[t]);
        if (!wanted) continue;
        const auto check = [&](const Shape& s) {
            if (s.material != material) return;
            const auto* mesh = std::get_if<MeshShape>(&s.geometry);
            const auto has = [&](const MeshAttribute& a) { return a.name == wanted->name; };
            if (!mesh || std::none_of(mesh->data->attributes.begin(), mesh->data->attributes.end(), has))
                throw Error(s.where.text() + ": the material of this shape looks up the attribute '" + wanted->name + "', which the shape does not have");
            check_values(*std::find_if(mesh->data->attributes.begin(), mesh->data->attributes.end(), has), *wanted, s);
        };
        for (const Shape& s : scene.description.shapes) check(s);
        for (const ShapeGroup& g : scene.description.groups)
            for (const Shape& s : g.shapes) check(s);
    }
}

}  // namespace

void compile_materials(Scene& scene) {
    const SceneDescription& d = scene.description;
    std::vector<LayeredPart> parts;
    // A material that no shape uses costs nothing: it calls for no effect.
    std::vector<bool> used(d.materials.size(), false);
    for (const Shape& s : d.shapes) used[s.material] = true;
    for (const ShapeGroup& g : d.groups)
        for (const Shape& s : g.shapes) used[s.material] = true;
    for (std::size_t i = 0; i < d.materials.size(); ++i) {
        const Material& m = d.materials[i];
        MaterialSides sides;
        if (used[i]) {
            const std::size_t first_texture = scene.textures.size();
            const Caller caller(scene, m.where);
            sides.front = sides.back = add_side(scene, parts, m.front, sides.anisotropic);
            if (m.back) sides.back = add_side(scene, parts, *m.back, sides.anisotropic);
            if (m.two_sided && (scene.sides[sides.front].layered >= 0 || scene.sides[sides.back].layered >= 0)) {
                sides.front = sides.back = add_two_sided(scene, parts, sides.front, sides.back);
            } else if (m.two_sided) {
                sides.two_sided = true;
                scene.effects |= {Effect::two_sided};
            }
            check_attributes(scene, static_cast<std::uint32_t>(i), first_texture);
        }
        scene.materials.push_back(sides);
    }
    if (!parts.empty()) scene.layered = std::make_shared<const LayeredParts>(LayeredParts{std::move(parts)});
}

}  // namespace koksma::detail
