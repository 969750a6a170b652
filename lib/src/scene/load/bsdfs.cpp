#include "bsdfs.h"

#include "fail.h"
#include "textures.h"

#include <array>
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

const std::vector<std::string> kTypes{"diffuse", "dielectric", "conductor", "roughconductor", "twosided"};

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

Dielectric parse_dielectric(Properties& p) {
    Dielectric d;
    d.int_ior = read_index(p, "int_ior", d.int_ior);
    d.ext_ior = read_index(p, "ext_ior", d.ext_ior);
    d.specular_reflectance = read_constant(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance);
    d.specular_transmittance = read_constant(p, "specular_transmittance", Rgb(1.0f), ColorUse::reflectance);
    return d;
}

/// Without eta and k a mirror; each alone leaves the other at Mitsuba's 0 and 1.
Conductor parse_conductor(Properties& p) {
    Conductor c;
    const std::string material = p.text("material", "none");
    if (material != "none")
        fail(p.where("material"), "metal '{}' is not supported by name; supported: none, or its <rgb name=\"eta\"/> and <rgb name=\"k\"/>",
             material);
    c.perfect = !p.has("eta") && !p.has("k");
    c.eta = read_constant(p, "eta", Rgb(0.0f), ColorUse::index);
    c.k = read_constant(p, "k", Rgb(1.0f), ColorUse::index);
    c.specular_reflectance = read_constant(p, "specular_reflectance", Rgb(1.0f), ColorUse::reflectance);
    return c;
}

RoughConductor parse_rough_conductor(Properties& p, Context& context) {
    RoughConductor r;
    r.base = parse_conductor(p);
    r.distribution = p.choice("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx" ? RoughConductor::Distribution::ggx
                                                                                        : RoughConductor::Distribution::beckmann;
    if (!p.boolean("sample_visible", true))
        fail(p.where("sample_visible"), "'sample_visible' must be true: only visible normals are sampled");
    if (p.has("alpha_u") || p.has("alpha_v")) {
        if (!p.has("alpha_u") || !p.has("alpha_v") || p.has("alpha")) fail(p.where(), "give 'alpha', or both 'alpha_u' and 'alpha_v'");
        r.alpha_u = read_texture(p, "alpha_u", Rgb(0.1f), ColorUse::roughness, context);
        r.alpha_v = read_texture(p, "alpha_v", Rgb(0.1f), ColorUse::roughness, context);
    } else {
        r.alpha_u = r.alpha_v = read_texture(p, "alpha", Rgb(0.1f), ColorUse::roughness, context);
    }
    return r;
}

OneSidedMaterial parse_one_sided(const Element& bsdf, Context& context) {
    Properties p(bsdf, context.ids, kTypes);
    OneSidedMaterial m;
    if (p.type() == "diffuse")
        m = parse_diffuse(p, context);
    else if (p.type() == "dielectric")
        m = parse_dielectric(p);
    else if (p.type() == "conductor")
        m = parse_conductor(p);
    else if (p.type() == "roughconductor")
        m = parse_rough_conductor(p, context);
    else
        fail(p.where(), "a '{}' inside another bsdf is not supported", p.type());
    p.finish();
    return m;
}

void parse_two_sided(const Element& bsdf, Context& context, Material& material) {
    Properties p(bsdf, context.ids, kTypes);
    const auto nested = p.objects("bsdf");
    p.finish();
    if (nested.empty() || nested.size() > 2) fail(p.where(), "'twosided' takes one bsdf, or two (front, back); found {}", nested.size());
    material.two_sided = true;
    material.front = parse_one_sided(*nested.front(), context);
    material.back = nested.size() == 2 ? parse_one_sided(*nested.back(), context) : material.front;
    if (std::holds_alternative<Dielectric>(material.front) || std::holds_alternative<Dielectric>(*material.back))
        fail(p.where(), "a dielectric cannot be inside 'twosided': it has two sides already");
}

}  // namespace

Material parse_material(const Element& bsdf, Context& context) {
    Material material;
    if (const std::string* id = bsdf.find("id")) material.id = *id;
    material.where = bsdf.where;
    if (bsdf.required("type") == "twosided")
        parse_two_sided(bsdf, context, material);
    else
        material.front = parse_one_sided(bsdf, context);
    return material;
}

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
