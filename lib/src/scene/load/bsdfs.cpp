#include "bsdfs.h"

#include "fail.h"
#include "metals.h"
#include "textures.h"

#include <array>
#include <cmath>
#include <utility>

namespace koksma::loader {
namespace {

// Names and values as Mitsuba 3 has them (its dielectric accepts the names; values read back from it).
constexpr std::array<std::pair<std::string_view, float>, 23> kIndices{
    {{"vacuum", 1.0f},      {"helium", 1.000036f},        {"hydrogen", 1.000132f},
     {"air", 1.000277f},    {"carbon dioxide", 1.00045f}, {"water", 1.3330f},
     {"acetone", 1.36f},    {"ethanol", 1.361f},          {"carbon tetrachloride", 1.461f},
     {"glycerol", 1.4729f}, {"benzene", 1.501f},          {"silicone oil", 1.52045f},
     {"bromine", 1.661f},   {"water ice", 1.31f},         {"fused quartz", 1.458f},
     {"pyrex", 1.470f},     {"acrylic glass", 1.49f},     {"polypropylene", 1.49f},
     {"bk7", 1.5046f},      {"sodium chloride", 1.544f},  {"amber", 1.55f},
     {"pet", 1.575f},       {"diamond", 2.419f}}};

const std::vector<std::string> kTypes{"diffuse", "dielectric",   "thindielectric", "roughdielectric", "conductor", "roughconductor", "plastic",
                                      "roughplastic", "principled", "blendbsdf",      "mask",            "null",      "normalmap",      "bumpmap", "twosided"};
/// Materials in materials; a <ref> may lead a file back into itself.
constexpr int kDeepest = 8;

float named_index(Properties& p, const std::string& parameter) {
    const std::string name = p.required_text(parameter);
    std::vector<std::string> names;
    for (const auto& [known, value] : kIndices) {
        if (known == name) return value;
        names.emplace_back(known);
    }
    fail(p.where(parameter), "there is no index of refraction for '{}'; {}known: {}, or a <float>", name, did_you_mean(name, names),
         list_of(names));
}

float read_index(Properties& p, const std::string& parameter, float default_value) {
    if (p.has(parameter) && p.is(parameter, "string")) return named_index(p, parameter);
    const double value = p.number(parameter, static_cast<double>(default_value));
    if (!(static_cast<float>(value) > 0.0f))
        fail(p.where(parameter), "'{}' is {}; an index of refraction must be positive", parameter, value);
    return static_cast<float>(value);
}

Diffuse parse_diffuse(Properties& p, Context& context) {
    return {read_texture(p, "reflectance", Rgb(0.5f), ColorUse::reflectance, context)};
}

template <class Material>
void read_indices(Properties& p, Material& m) {
    m.int_ior = read_index(p, "int_ior", m.int_ior);
    m.ext_ior = read_index(p, "ext_ior", m.ext_ior);
}

/// Dielectric or ThinDielectric.
template <class Smooth>
Smooth parse_smooth_dielectric(Properties& p) {
    Smooth d;
    read_indices(p, d);
    d.specular_reflectance = read_constant(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance);
    d.specular_transmittance = read_constant(p, "specular_transmittance", Rgb(1.0f), ColorUse::reflectance);
    return d;
}

/// Without eta and k a mirror; each alone leaves the other at Mitsuba's 0 and 1.
Conductor parse_conductor(Properties& p) {
    Conductor c;
    const std::string material = p.text("material", "none");
    if (material != "none") {
        if (p.has("eta") || p.has("k")) fail(p.where("material"), "give 'material', or 'eta' and 'k'");
        const Metal metal = named_metal(material, p.where("material"));
        c.perfect = false;
        c.eta = metal.eta;
        c.k = metal.k;
        c.specular_reflectance = read_constant(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance);
        return c;
    }
    c.perfect = !p.has("eta") && !p.has("k");
    c.eta = read_constant(p, "eta", Rgb(0.0f), ColorUse::index);
    c.k = read_constant(p, "k", Rgb(1.0f), ColorUse::index);
    c.specular_reflectance = read_constant(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance);
    return c;
}

Facets read_distribution(Properties& p) {
    const bool ggx = p.choice("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx";
    // How normals are sampled changes no expected image, so what is not done must not be asked for.
    if (!p.boolean("sample_visible", true))
        fail(p.where("sample_visible"), "'sample_visible' must be true: only visible normals are sampled");
    return ggx ? Facets::ggx : Facets::beckmann;
}

/// distribution, alpha or alpha_u and alpha_v.
template <class Rough>
void read_facets(Properties& p, Rough& r, Context& context) {
    r.distribution = read_distribution(p);
    if (p.has("alpha_u") || p.has("alpha_v")) {
        if (!p.has("alpha_u") || !p.has("alpha_v") || p.has("alpha")) fail(p.where(), "give 'alpha', or both 'alpha_u' and 'alpha_v'");
        r.alpha_u = read_texture(p, "alpha_u", Rgb(0.1f), ColorUse::roughness, context);
        r.alpha_v = read_texture(p, "alpha_v", Rgb(0.1f), ColorUse::roughness, context);
    } else {
        r.alpha_u = r.alpha_v = read_texture(p, "alpha", Rgb(0.1f), ColorUse::roughness, context);
    }
}

RoughConductor parse_rough_conductor(Properties& p, Context& context) {
    RoughConductor r;
    r.base = parse_conductor(p);
    read_facets(p, r, context);
    return r;
}

RoughDielectric parse_rough_dielectric(Properties& p, Context& context) {
    RoughDielectric r;
    read_indices(p, r);
    read_facets(p, r, context);
    r.specular_reflectance = read_texture(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance, context);
    r.specular_transmittance = read_texture(p, "specular_transmittance", Rgb(1.0f), ColorUse::reflectance, context);
    return r;
}

/// What Plastic and RoughPlastic have in common.
template <class AnyPlastic>
AnyPlastic parse_plastic(Properties& p, Context& context) {
    AnyPlastic m;
    read_indices(p, m);
    m.diffuse_reflectance = read_texture(p, "diffuse_reflectance", Rgb(0.5f), ColorUse::reflectance, context);
    m.specular_reflectance = read_texture(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance, context);
    m.nonlinear = p.boolean("nonlinear", false);
    return m;
}

RoughPlastic parse_rough_plastic(Properties& p, Context& context) {
    RoughPlastic m = parse_plastic<RoughPlastic>(p, context);
    if (m.int_ior == m.ext_ior) fail(p.where("int_ior"), "'int_ior' and 'ext_ior' of 'roughplastic' must differ");
    m.distribution = read_distribution(p);
    m.alpha = static_cast<float>(p.number("alpha", 0.1));
    if (!(m.alpha >= 0.0f)) fail(p.where("alpha"), "'alpha' is {}; a roughness must not be negative", m.alpha);
    return m;
}

float sampling_rate(Properties& p, const std::string& name) {
    const double rate = p.number(name, 1.0);
    if (!(rate > 0.0)) fail(p.where(name), "'{}' is {}; a rate of sampling must be positive, or light is lost", name, rate);
    return static_cast<float>(rate);
}

Principled parse_principled(Properties& p, Context& context) {
    Principled m;
    m.base_color = read_texture(p, "base_color", Rgb(0.5f), ColorUse::reflectance, context);
    m.roughness = read_texture(p, "roughness", Rgb(0.5f), ColorUse::roughness, context);
    const std::pair<const char*, Texture*> sliders[] = {{"anisotropic", &m.anisotropic}, {"metallic", &m.metallic},   {"spec_trans", &m.spec_trans},
                                                        {"spec_tint", &m.spec_tint},     {"sheen", &m.sheen},         {"sheen_tint", &m.sheen_tint},
                                                        {"flatness", &m.flatness},       {"clearcoat", &m.clearcoat}, {"clearcoat_gloss", &m.clearcoat_gloss}};
    for (const auto& [name, texture] : sliders) *texture = read_texture(p, name, Rgb(0.0f), ColorUse::reflectance, context);
    if (p.has("eta") && p.has("specular")) fail(p.where("specular"), "give 'eta' or 'specular': one follows from the other");
    const auto* constant = std::get_if<Rgb>(&m.spec_trans);
    const bool transmits = constant == nullptr || *constant != Rgb(0.0f);
    if (p.has("eta")) {
        m.eta = read_index(p, "eta", 1.5f);
        if (transmits && m.eta == 1.0f) m.eta = 1.001f;  // as Mitsuba 3 has it
    } else {
        double specular = p.number("specular", 0.5);
        if (!(specular >= 0.0 && specular <= 1.0)) fail(p.where("specular"), "'specular' is {}; it must be in [0, 1]", specular);
        if (transmits && specular == 0.0) specular = 1e-3;
        m.eta = static_cast<float>(2.0 / (1.0 - std::sqrt(0.08 * specular)) - 1.0);
    }
    m.main_specular_sampling_rate = sampling_rate(p, "main_specular_sampling_rate");
    m.clearcoat_sampling_rate = sampling_rate(p, "clearcoat_sampling_rate");
    m.diffuse_reflectance_sampling_rate = sampling_rate(p, "diffuse_reflectance_sampling_rate");
    return m;
}

Material parse_any(const Element& bsdf, Context& context, int depth);

/// The materials inside another. @throws Error unless there are `count`
std::vector<Material> parse_nested(Properties& p, Context& context, std::size_t count, int depth) {
    const auto nested = p.objects("bsdf");
    if (nested.size() != count) fail(p.where(), "'{}' takes {} bsdf{}; found {}", p.type(), count, count == 1 ? "" : "s", nested.size());
    std::vector<Material> out;
    for (const Element* e : nested) out.push_back(parse_any(*e, context, depth + 1));
    return out;
}

Blend parse_blend(Properties& p, Context& context, int depth) {
    if (!p.has("weight")) fail(p.where(), "'blendbsdf' needs a 'weight': a <float> or a <texture>");
    Blend b;
    b.weight = read_texture(p, "weight", Rgb(0.5f), ColorUse::any, context);  // of a texture, what is outside [0, 1] is cut off
    b.nested = parse_nested(p, context, 2, depth);
    return b;
}

Mask parse_mask(Properties& p, Context& context, int depth) {
    Mask m;
    m.opacity = read_texture(p, "opacity", Rgb(0.5f), ColorUse::any, context);
    m.nested = parse_nested(p, context, 1, depth);
    return m;
}

Bending parse_bending(Properties& p, Context& context, int depth) {
    Bending b;
    b.flip_invalid_normals = p.boolean("flip_invalid_normals", true);
    b.use_shadowing_function = p.boolean("use_shadowing_function", true);
    b.nested = parse_nested(p, context, 1, depth);
    return b;
}

NormalMap parse_normal_map(Properties& p, Context& context, int depth) {
    if (!p.has("normalmap")) fail(p.where(), "'normalmap' needs a <texture name=\"normalmap\"/>");
    NormalMap m;
    m.normals = read_texture(p, "normalmap", Rgb(0.5f, 0.5f, 1.0f), ColorUse::any, context);
    m.bending = parse_bending(p, context, depth);
    return m;
}

BumpMap parse_bump_map(Properties& p, Context& context, int depth) {
    const Element* texture = p.object("texture");
    if (!texture) fail(p.where(), "'bumpmap' needs a <texture>");
    BumpMap m;
    m.height = parse_texture(*texture, ColorUse::any, context);
    m.scale = static_cast<float>(p.number("scale", 1.0));
    m.bending = parse_bending(p, context, depth);
    return m;
}

bool transmits(const Material& material);
bool transmits(const OneSidedMaterial& m) {
    const auto any_of = [](const std::vector<Material>& nested) {
        for (const Material& n : nested)
            if (transmits(n)) return true;
        return false;
    };
    if (const auto* blend = std::get_if<Blend>(&m)) return any_of(blend->nested);
    if (const auto* map = std::get_if<NormalMap>(&m)) return any_of(map->bending.nested);
    if (const auto* map = std::get_if<BumpMap>(&m)) return any_of(map->bending.nested);
    if (const auto* principled = std::get_if<Principled>(&m)) {
        const auto* constant = std::get_if<Rgb>(&principled->spec_trans);
        return constant == nullptr || *constant != Rgb(0.0f);
    }
    return std::holds_alternative<Dielectric>(m) || std::holds_alternative<ThinDielectric>(m) || std::holds_alternative<RoughDielectric>(m) ||
           std::holds_alternative<Mask>(m) || std::holds_alternative<Null>(m);
}
bool transmits(const Material& material) { return transmits(material.front) || (material.back && transmits(*material.back)); }

OneSidedMaterial parse_one_sided(const Element& bsdf, Context& context, int depth) {
    Properties p(bsdf, context.ids, kTypes);
    OneSidedMaterial m;
    if (p.type() == "diffuse")
        m = parse_diffuse(p, context);
    else if (p.type() == "dielectric")
        m = parse_smooth_dielectric<Dielectric>(p);
    else if (p.type() == "thindielectric")
        m = parse_smooth_dielectric<ThinDielectric>(p);
    else if (p.type() == "roughdielectric")
        m = parse_rough_dielectric(p, context);
    else if (p.type() == "conductor")
        m = parse_conductor(p);
    else if (p.type() == "roughconductor")
        m = parse_rough_conductor(p, context);
    else if (p.type() == "plastic")
        m = parse_plastic<Plastic>(p, context);
    else if (p.type() == "roughplastic")
        m = parse_rough_plastic(p, context);
    else if (p.type() == "principled")
        m = parse_principled(p, context);
    else if (p.type() == "normalmap")
        m = parse_normal_map(p, context, depth);
    else if (p.type() == "bumpmap")
        m = parse_bump_map(p, context, depth);
    else if (p.type() == "blendbsdf")
        m = parse_blend(p, context, depth);
    else if (p.type() == "mask")
        m = parse_mask(p, context, depth);
    else if (p.type() == "null")
        m = Null{};
    else
        fail(p.where(), "a '{}' inside 'twosided' is not supported", p.type());
    p.finish();
    return m;
}

void parse_two_sided(const Element& bsdf, Context& context, Material& material, int depth) {
    Properties p(bsdf, context.ids, kTypes);
    const auto nested = p.objects("bsdf");
    p.finish();
    if (nested.empty() || nested.size() > 2) fail(p.where(), "'twosided' takes one bsdf, or two (front, back); found {}", nested.size());
    material.two_sided = true;
    material.front = parse_one_sided(*nested.front(), context, depth + 1);
    material.back = nested.size() == 2 ? parse_one_sided(*nested.back(), context, depth + 1) : material.front;
    if (transmits(material))
        fail(p.where(), "a material that lets light through (dielectric, mask, ...) cannot be inside 'twosided': it has two sides already");
}

Material parse_any(const Element& bsdf, Context& context, int depth) {
    if (depth > kDeepest) fail(bsdf.where, "bsdfs are nested more than {} deep; does a <ref> lead back into its own bsdf?", kDeepest);
    Material material;
    if (const std::string* id = bsdf.find("id")) material.id = *id;
    material.where = bsdf.where;
    if (bsdf.required("type") == "twosided")
        parse_two_sided(bsdf, context, material, depth);
    else
        material.front = parse_one_sided(bsdf, context, depth);
    return material;
}

}  // namespace

Material parse_material(const Element& bsdf, Context& context) { return parse_any(bsdf, context, 0); }

std::uint32_t material_of(const Element& bsdf, Context& context) {
    if (const auto it = context.materials.find(&bsdf); it != context.materials.end()) return it->second;
    Material material = parse_material(bsdf, context);
    const auto index = static_cast<std::uint32_t>(context.scene.materials.size());
    context.scene.materials.push_back(std::move(material));
    return context.materials[&bsdf] = index;
}

std::uint32_t black_material(Context& context) {
    if (!context.black_material) {
        context.black_material = static_cast<std::uint32_t>(context.scene.materials.size());
        Material black;
        black.front = Diffuse{Rgb(0.0f)};
        context.scene.materials.push_back(std::move(black));
    }
    return *context.black_material;
}

}  // namespace koksma::loader
