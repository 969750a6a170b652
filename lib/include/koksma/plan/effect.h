#pragma once
// What a scene calls for. Everything that costs dimensions or work and that a scene may lack has a name here.

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace koksma {

enum class Effect : std::uint8_t {
    lens,             ///< thin lens: a 2-D draw per camera ray
    light_choice,     ///< more than one light: a 1-D draw per bounce
    area_light,       ///< surfaces that emit: a 2-D draw per bounce, MIS
    sphere_light,     ///< among them spheres, sampled by their cone
    point_light,      ///< lights that only direct sampling can find: points, spots, directional lights, projectors
    environment,      ///< light from infinity
    diffuse,          ///< smooth BSDFs: a 2-D draw per bounce, direct light
    glossy,           ///< microfacet BSDFs
    specular,         ///< mirrors: delta directions
    dielectric,       ///< refraction: a path keeps the index that it is in
    two_sided,        ///< materials seen from behind
    texture,          ///< values that vary over a surface
    analytic_shape,   ///< spheres, disks and cylinders
    shading_normals,  ///< interpolated normals
    anisotropic,      ///< BSDFs that depend on the direction of u: a frame from the UVs
    roulette,         ///< Russian roulette: a 1-D draw per bounce from rr_depth on
    many_lights,      ///< so many that one is chosen for the point to be lit, by a tree
    mesh_attribute,   ///< textures that look up values of vertices and faces
    lobe,             ///< BSDFs that choose among lobes: a 1-D draw per bounce
    layered,          ///< materials of several lobes or parts (koksma/scene/bsdf/layered.h), computed one path at a time
    medium,           ///< participating media: a 1-D draw per bounce, of the distance
    heterogeneous,    ///< media that vary in space: a 1-D draw per bounce, of which collision is real
    null_boundary,    ///< surfaces that volumetric paths cross straight on, shadow rays too
    mask,             ///< such as stop a part of the paths: a 1-D draw per bounce
    instancing,       ///< groups of shapes that are seen through instances
    motion,           ///< instances that move while the shutter is open: a 1-D draw per camera ray
    one_technique,    ///< direct light by light sampling alone or by BSDF sampling alone, for comparisons
};
inline constexpr int kEffectCount = 27;

[[nodiscard]] constexpr std::string_view name(Effect e) noexcept {
    constexpr std::string_view kNames[kEffectCount] = {
        "lens",          "light_choice",  "area_light",  "sphere_light",   "point_light", "environment",    "diffuse",
        "glossy",        "specular",      "dielectric",  "two_sided",      "texture",     "analytic_shape", "shading_normals",
        "anisotropic",   "roulette",      "many_lights", "mesh_attribute", "lobe",        "layered",        "medium",
        "heterogeneous", "null_boundary", "mask",        "instancing",     "motion",      "one_technique"};
    return kNames[static_cast<int>(e)];
}

/// A set of effects; a structural type, so that kernels are templates on it.
struct EffectSet {
    std::uint32_t bits = 0;

    constexpr EffectSet() = default;
    constexpr explicit EffectSet(std::uint32_t b) : bits(b) {}
    constexpr EffectSet(std::initializer_list<Effect> effects) {
        for (const Effect e : effects) bits |= bit(e);
    }
    [[nodiscard]] static constexpr EffectSet all() { return EffectSet((1u << kEffectCount) - 1); }
    [[nodiscard]] constexpr bool has(Effect e) const noexcept { return (bits & bit(e)) != 0; }
    [[nodiscard]] constexpr bool contains(EffectSet other) const noexcept { return (bits & other.bits) == other.bits; }
    [[nodiscard]] constexpr EffectSet without(Effect e) const noexcept { return EffectSet(bits & ~bit(e)); }
    [[nodiscard]] constexpr int size() const noexcept {
        int n = 0;
        for (std::uint32_t b = bits; b != 0; b &= b - 1) ++n;
        return n;
    }
    constexpr EffectSet& operator|=(EffectSet o) noexcept {
        bits |= o.bits;
        return *this;
    }
    friend constexpr EffectSet operator|(EffectSet a, EffectSet b) noexcept { return a |= b; }
    friend constexpr bool operator==(EffectSet, EffectSet) = default;

    /// The effect of a name, or the empty set.
    [[nodiscard]] static constexpr EffectSet named(std::string_view text) noexcept {
        for (int i = 0; i < kEffectCount; ++i)
            if (name(static_cast<Effect>(i)) == text) return {static_cast<Effect>(i)};
        return {};
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> out;
        for (int i = 0; i < kEffectCount; ++i)
            if (has(static_cast<Effect>(i))) out.emplace_back(name(static_cast<Effect>(i)));
        return out;
    }

private:
    static constexpr std::uint32_t bit(Effect e) noexcept { return 1u << static_cast<int>(e); }
};

}  // namespace koksma
