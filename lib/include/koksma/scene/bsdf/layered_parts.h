#pragma once
// What layered materials are made of. To add one: its BSDF in a header of its own, a part here, its lookup or its two operators in layered.cpp.

#include <koksma/scene/bsdf/principled.h>
#include <koksma/scene/bsdf/rough_plastic.h>
#include <koksma/scene/texture.h>

#include <variant>
#include <vector>

namespace koksma {

/// Each: the BSDF, with the members that a texture may give.
struct RoughDielectricPart {
    RoughDielectricBsdf bsdf;
    TextureRef alpha_u, alpha_v, reflectance, transmittance;
};
struct PlasticPart {
    PlasticBsdf bsdf;
    TextureRef diffuse, specular;
};
struct RoughPlasticPart {
    RoughPlasticBsdf bsdf;
    TextureRef diffuse, specular;
};
struct PrincipledPart {
    PrincipledBsdf bsdf;
    TextureRef base_color, roughness, anisotropic, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness, clearcoat, clearcoat_gloss;
};
/// Others are indices into Scene::sides.
struct BlendPart {
    TextureRef weight;  ///< of the second
    std::uint32_t first = 0, second = 0;
};
/// What the opacity leaves passes straight on.
struct MaskPart {
    TextureRef opacity;
    std::uint32_t nested = 0;
};
struct NullPart {};
/// A two-sided material inside another.
struct TwoSidedPart {
    std::uint32_t front = 0, back = 0;
};
/// A material with other normals.
struct BendingPart {
    bool flip = true, shadow = true;
    std::uint32_t nested = 0;
};
struct NormalMapPart {
    TextureRef normals;
    BendingPart bending;
};
struct BumpMapPart {
    TextureRef height;
    float scale = 1.0f;
    BendingPart bending;
};
using LayeredPart = std::variant<RoughDielectricPart, PlasticPart, RoughPlasticPart, PrincipledPart, BlendPart, MaskPart, NullPart, TwoSidedPart,
                                 NormalMapPart, BumpMapPart>;

struct LayeredParts {
    std::vector<LayeredPart> parts;
};

}  // namespace koksma
