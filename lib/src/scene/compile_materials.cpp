#include <koksma/sampling/error.h>

#include "compile.h"

#include <algorithm>

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

struct SideCompiler {
    Scene& scene;
    MaterialSide side{};
    bool anisotropic = false;

    void conductor(const Conductor& c) {
        side.perfect = c.perfect;
        side.eta = c.eta;
        side.k = c.k;
        side.reflectance.constant = c.specular_reflectance;
    }
    void operator()(const Diffuse& d) {
        side.kind = BsdfKind::diffuse;
        side.reflectance = texture_ref(scene, d.reflectance);
        scene.effects |= {Effect::diffuse};
    }
    void operator()(const Dielectric& d) {
        side.kind = BsdfKind::dielectric;
        side.eta = Vec3f(d.int_ior / d.ext_ior);
        side.reflectance.constant = d.specular_reflectance;
        side.transmittance = d.specular_transmittance;
        scene.effects |= {Effect::dielectric};
    }
    void operator()(const Conductor& c) {
        side.kind = BsdfKind::conductor;
        conductor(c);
        scene.effects |= {Effect::specular};
    }
    void operator()(const RoughConductor& c) {
        side.kind = BsdfKind::rough_conductor;
        conductor(c.base);
        side.ggx = c.distribution == RoughConductor::Distribution::ggx;
        side.alpha_u = texture_ref(scene, c.alpha_u);
        side.alpha_v = texture_ref(scene, c.alpha_v);
        if (!is_same(c.alpha_u, c.alpha_v)) {
            anisotropic = true;
            scene.effects |= {Effect::anisotropic};
        }
        scene.effects |= {Effect::glossy};
    }
};

std::uint32_t add_side(Scene& scene, const OneSidedMaterial& material, MaterialSides& sides) {
    SideCompiler compiler{scene};
    std::visit(compiler, material);
    sides.anisotropic = sides.anisotropic || compiler.anisotropic;
    scene.sides.push_back(compiler.side);
    return static_cast<std::uint32_t>(scene.sides.size() - 1);
}

/// @throws Error for a shape whose mesh lacks an attribute that its material looks up
void check_attributes(const Scene& scene, std::uint32_t material, std::size_t first_texture) {
    for (std::size_t t = first_texture; t < scene.textures.size(); ++t) {
        const auto* wanted = std::get_if<MeshAttributeTexture>(&scene.textures[t]);
        if (!wanted) continue;
        for (const Shape& s : scene.description.shapes) {
            if (s.material != material) continue;
            const auto* mesh = std::get_if<MeshShape>(&s.geometry);
            const auto has = [&](const MeshAttribute& a) { return a.name == wanted->name; };
            if (!mesh || std::none_of(mesh->data->attributes.begin(), mesh->data->attributes.end(), has))
                throw Error(s.where.text() + ": the material of this shape looks up the attribute '" + wanted->name + "', which the shape does not have");
        }
    }
}

}  // namespace

void compile_materials(Scene& scene) {
    const SceneDescription& d = scene.description;
    // A material that no shape uses costs nothing: it calls for no effect.
    std::vector<bool> used(d.materials.size(), false);
    for (const Shape& s : d.shapes) used[s.material] = true;
    for (std::size_t i = 0; i < d.materials.size(); ++i) {
        const Material& m = d.materials[i];
        MaterialSides sides;
        if (used[i]) {
            const std::size_t first_texture = scene.textures.size();
            sides.front = sides.back = add_side(scene, m.front, sides);
            sides.two_sided = m.two_sided;
            if (m.back) sides.back = add_side(scene, *m.back, sides);
            if (m.two_sided) scene.effects |= {Effect::two_sided};
            check_attributes(scene, static_cast<std::uint32_t>(i), first_texture);
        }
        scene.materials.push_back(sides);
    }
}

}  // namespace koksma::detail
