#pragma once
// One material, or some, of each layered kind.

#include "describe.h"

namespace koksma::testing {

[[nodiscard]] inline Material material(std::string id, OneSidedMaterial front, bool two_sided = false) {
    Material m;
    m.id = std::move(id);
    m.front = front;
    m.two_sided = two_sided;
    if (two_sided) m.back = std::move(front);
    return m;
}

[[nodiscard]] inline RoughDielectric rough_glass(Facets distribution, float alpha_u, float alpha_v, float int_ior = 1.5f, float ext_ior = 1.0f) {
    RoughDielectric r;
    r.int_ior = int_ior;
    r.ext_ior = ext_ior;
    r.distribution = distribution;
    r.alpha_u = Rgb(alpha_u);
    r.alpha_v = Rgb(alpha_v);
    return r;
}
[[nodiscard]] inline RoughPlastic rough_plastic(Facets distribution, float alpha) {
    RoughPlastic r;
    r.distribution = distribution;
    r.alpha = alpha;
    r.diffuse_reflectance = Rgb(0.1f, 0.27f, 0.36f);
    return r;
}
/// Everything on.
[[nodiscard]] inline Principled all_sliders() {
    Principled p;
    p.base_color = Rgb(0.7f, 0.4f, 0.2f);
    p.roughness = Rgb(0.55f);
    p.anisotropic = Rgb(0.4f);
    p.metallic = Rgb(0.3f);
    p.spec_trans = Rgb(0.4f);
    p.spec_tint = Rgb(0.6f);
    p.sheen = Rgb(0.2f);
    p.sheen_tint = Rgb(0.5f);
    p.flatness = Rgb(0.7f);
    p.clearcoat = Rgb(0.5f);
    p.clearcoat_gloss = Rgb(0.2f);
    return p;
}
[[nodiscard]] inline BitmapTexture bumps() {
    BitmapTexture t;
    t.image = image(4, 4, {Rgb(0.1f), Rgb(0.3f), Rgb(0.2f), Rgb(0.0f), Rgb(0.4f), Rgb(0.2f), Rgb(0.3f), Rgb(0.1f), Rgb(0.0f), Rgb(0.1f), Rgb(0.4f), Rgb(0.2f),
                           Rgb(0.2f), Rgb(0.1f), Rgb(0.0f), Rgb(0.3f)});
    return t;
}

[[nodiscard]] inline std::vector<Material> layered_materials() {
    RoughConductor brushed;
    brushed.distribution = Facets::ggx;
    brushed.alpha_u = Rgb(0.5f);
    brushed.alpha_v = Rgb(0.2f);
    Plastic nonlinear;
    nonlinear.diffuse_reflectance = Rgb(0.1f, 0.27f, 0.36f);
    nonlinear.int_ior = 1.9f;
    nonlinear.nonlinear = true;
    Principled opaque;
    opaque.base_color = Rgb(0.7f, 0.4f, 0.2f);
    const Material diffuse = material("diffuse", Diffuse{Rgb(0.2f, 0.5f, 0.8f)}), both = material("both", Diffuse{Rgb(0.2f, 0.5f, 0.8f)}, true);
    const NormalMap normals{CheckerboardTexture{Rgb(0.65f, 0.45f, 0.9f), Rgb(0.4f, 0.6f, 0.8f), glm::dmat3(1.0)}, {true, true, {material("", brushed)}}};
    return {material("rough glass, ggx", rough_glass(Facets::ggx, 0.4f, 0.4f)),
            material("rough glass, beckmann, anisotropic", rough_glass(Facets::beckmann, 0.5f, 0.3f)),
            material("rough bubble", rough_glass(Facets::ggx, 0.3f, 0.3f, 1.0f, 1.33f)),
            material("plastic", Plastic{}),
            material("plastic, nonlinear, two-sided", nonlinear, true),
            material("rough plastic, ggx", rough_plastic(Facets::ggx, 0.3f)),
            material("rough plastic, beckmann", rough_plastic(Facets::beckmann, 0.3f)),
            material("principled", opaque),
            material("principled, all sliders", all_sliders()),
            material("blend", Blend{Rgb(0.3f), {diffuse, material("", rough_glass(Facets::ggx, 0.5f, 0.5f))}}),
            material("blend by texture", Blend{CheckerboardTexture{}, {both, material("", Plastic{})}}),
            material("mask", Mask{CheckerboardTexture{Rgb(0.0f), Rgb(0.8f), glm::dmat3(1.0)}, {both}}),
            material("null", Null{}),
            material("normal map", normals, true),
            material("bump map", BumpMap{bumps(), 0.3f, {false, true, {material("", rough_plastic(Facets::ggx, 0.3f))}}})};
}

}  // namespace koksma::testing
