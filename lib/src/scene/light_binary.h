#pragma once
// The binary tree over lights from which the light tree is made.

#include <koksma/scene/light_tree.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace koksma::detail {

struct Bounds {
    Vec3d lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};

    void grow(Vec3d a, Vec3d b) {
        lo = {std::min(lo.x, a.x), std::min(lo.y, a.y), std::min(lo.z, a.z)};
        hi = {std::max(hi.x, b.x), std::max(hi.y, b.y), std::max(hi.z, b.z)};
    }
    [[nodiscard]] Vec3d middle() const { return (lo + hi) * 0.5; }
    [[nodiscard]] Vec3d size() const { return hi - lo; }
};

[[nodiscard]] inline double axis_of(Vec3d v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// What a set of lights is to those that it may light.
struct Group {
    Bounds bounds;
    NormalCone normals;
    double intensity = 0.0;
    int count = 0;

    void add(const Group& g) {
        if (g.count == 0) return;
        normals = count == 0 ? g.normals : unite(normals, g.normals);
        bounds.grow(g.bounds.lo, g.bounds.hi);
        intensity += g.intensity;
        count += g.count;
    }
};

/// A node of the binary tree.
struct BinaryNode {
    Group group;
    std::uint32_t left = 0, right = 0;  ///< 0, the root: this is a leaf
    std::uint32_t leaf = 0;             ///< index in leaves
};

/// Splits where the surface area orientation heuristic finds it cheapest.
/// @param leaves  not empty; they change their order, and neighbours in it are neighbours in the tree
/// @param halves_from  from this depth on, two halves of one number of leaves: no branch is longer than this and their log2
/// @return        the root first
/// Source: Conty Estevez & Kulla 2018, section 4.4
[[nodiscard]] std::vector<BinaryNode> make_binary_tree(std::vector<LightLeaf>& leaves, int halves_from);

}  // namespace koksma::detail
