#pragma once
// Which of many lights to sample at a point: a tree over all lights that lie somewhere, descended by importance. Eight children
// a node: three levels of a binary tree are decided at once, from the bounds of the third, which know more than those of the
// first; and eight estimates are one loop for a compiler to vectorise.
//
// Limits: one light a choice, no splitting of the tree. A number u of 24 bits cannot tell apart more than 2^24 lights: one of
// probability q is met q +- 2^-24 of the time. A textured light counts with the mean of its whole texture.
// Source: Conty Estevez & Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", PACMCGIT 1(2)

#include <koksma/math/vec3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace koksma {

/// Instead of a triangle: the light as a whole.
inline constexpr std::uint32_t kWholeLight = 0xffffffffu;

/// A light and how it was chosen. probability == 0: there is none to choose.
struct LightChoice {
    std::uint32_t light = 0;               ///< index into Scene::lights
    std::uint32_t triangle = kWholeLight;  ///< of a mesh that is chosen by triangle, counted from its first
    float probability = 1.0f;
    float u = 0.0f;                        ///< what is left of the number, in [0, 1)
};

/// Normals of emission: all within `angle` (radians, [0, pi]) of `axis`; light leaves within a quarter turn of a normal.
struct NormalCone {
    Vec3f axis{0.0f, 0.0f, 1.0f};
    float angle = 0.0f;
};

/// Something that the tree can choose: a light, or one triangle of a mesh light.
struct LightLeaf {
    std::uint32_t light = 0, triangle = kWholeLight;
    Vec3d lo, hi;            ///< bounds, metres
    NormalCone normals;
    double intensity = 0.0;  ///< luminance toward where it shines most, W/sr; 0: never chosen
};

struct LightTree {
    static constexpr int kTrailBits = 3, kWidth = 1 << kTrailBits;
    using Lanes = std::array<float, kWidth>;
    /// What a node knows of its children, lane by lane.
    struct Node {
        Lanes center[3]{};     ///< of the bounds, metres
        Lanes half[3]{};       ///< half extents, in units of 1 / scale, rounded up
        Lanes axis[3]{};       ///< of the cone of normals
        Lanes cos_normals{};   ///< of the cone's half angle
        Lanes intensity{};     ///< as a part of the whole tree's; 0 in lanes that are not used
        std::array<std::uint32_t, kWidth> child{};  ///< index in nodes; of a leaf, kLeaf | its index in leaves
    };
    struct LeafId {
        std::uint32_t light, triangle;
    };
    static constexpr std::uint32_t kLeaf = 0x80000000u;

    std::vector<Node> nodes;                ///< the root first
    std::vector<LeafId> leaves;
    std::vector<std::uint32_t> first_trail;  ///< by light, and one more: where its entries in trails begin
    /// The way from the root, three bits a level, lowest first, above it a 1 that ends it; 0: never chosen.
    std::vector<std::uint64_t> trails;
    Vec3f origin{0.0f};       ///< middle of all lights
    float scale = 1.0f;       ///< 1 / radius of all lights
    /// Lights at infinity, which have no place in a tree, and their probabilities among themselves.
    struct Distant {
        std::uint32_t light;
        float probability;
    };
    std::vector<Distant> distant;
    float distant_share = 0.0f;  ///< probability of all of them; 0: there is none

    /// True if lights are not chosen by a tree.
    [[nodiscard]] bool empty() const noexcept { return trails.empty(); }

    /// Chooses a light for a reflecting surface.
    /// @param p  point to be lit
    /// @param n  unit normal on the side that reflects; what lies wholly below its horizon is not chosen
    /// @return   probability 0 if no light can reach p, and if the way down ends where both children turn out unable to
    /// @note     O(log n); nondecreasing in u: it walks through the leaves in their order, lights at infinity first
    [[nodiscard]] LightChoice choose(Vec3f p, Vec3f n, float u) const noexcept;

    /// @return  the probability with which choose(p, n, u) takes the light (and the triangle, of a mesh): the same bits
    [[nodiscard]] float probability(std::uint32_t light, std::uint32_t triangle, Vec3f p, Vec3f n) const noexcept;

    /// Nodes that choose() looks at on its way to this leaf. @pre it can be chosen
    [[nodiscard]] int depth(std::uint32_t light, std::uint32_t triangle) const noexcept;

    /// Generous estimates of the irradiance from each child, in the tree's own units: > 0 if anything in it can light p.
    /// @param p  as pulled() gives it
    [[nodiscard]] Lanes importance(const Node& node, Vec3f p, Vec3f n) const noexcept;

    /// The point, or if it is farther than 1e9 radii, where distances are all one, the point at 1e9 radii on the way to it.
    [[nodiscard]] Vec3f pulled(Vec3f p) const noexcept;
};

/// @param leaves       by light, and by triangle within a light: 0, 1, 2 ...; some may have intensity 0, not all
/// @param light_count  size of Scene::lights
[[nodiscard]] LightTree build_light_tree(std::span<const LightLeaf> leaves, std::size_t light_count);

/// The smallest cone around two cones.
[[nodiscard]] NormalCone unite(const NormalCone& a, const NormalCone& b) noexcept;

}  // namespace koksma
