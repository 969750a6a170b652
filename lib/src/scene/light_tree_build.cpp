#include "light_binary.h"

#include <koksma/simd/elementary.h>

#include <cmath>

namespace koksma {

namespace {

using detail::BinaryNode;

/// An intensity is at least this part of the sum, so that no product on the way down underflows. 10,000 dark lights together
/// take 1e-4 of the samples.
constexpr double kFaintest = 1e-8;

/// What a trail of 64 bits has room for, its end excepted.
constexpr int kLevels = 63 / LightTree::kTrailBits;

/// Gathers a binary tree into nodes of eight.
class Builder {
public:
    Builder(LightTree& tree, std::vector<LightLeaf> leaves, int halves_from)
        : tree_(tree), leaves_(std::move(leaves)), binary_(detail::make_binary_tree(leaves_, halves_from)) {}

    /// @return  false if a way is too long for its trail
    [[nodiscard]] bool build() {
        const detail::Bounds& all = binary_[0].group.bounds;
        tree_.origin = to_float(all.middle());
        // Lights in one place have no radius: then distances are measured by the place's own, or by a unit.
        tree_.scale = static_cast<float>(1.0 / std::max({0.5 * length(all.size()), 1e-6 * length(all.middle()), 1e-18}));
        for (const LightLeaf& leaf : leaves_) tree_.leaves.push_back({leaf.light, leaf.triangle});
        return gather(0, 0, 0);
    }

private:
    /// Makes the node that has the descendants of binary node `from` as children, the largest opened first, in their order.
    bool gather(std::uint32_t from, std::uint64_t way, int depth) {
        std::vector<std::uint32_t> children{from};
        while (children.size() < LightTree::kWidth) {
            std::size_t largest = 0;
            for (std::size_t k = 1; k < children.size(); ++k)
                if (binary_[children[k]].group.count > binary_[children[largest]].group.count) largest = k;
            const BinaryNode& opened = binary_[children[largest]];
            if (opened.right == 0) break;
            children[largest] = opened.left;
            children.insert(children.begin() + static_cast<std::ptrdiff_t>(largest) + 1, opened.right);
        }
        if (depth == kLevels) return false;
        const auto index = tree_.nodes.size();
        tree_.nodes.emplace_back();
        for (std::size_t k = 0; k < children.size(); ++k) {
            const BinaryNode& child = binary_[children[k]];
            const std::uint64_t to = way | std::uint64_t{k} << (LightTree::kTrailBits * depth);
            set(tree_.nodes[index], k, child.group);
            std::uint32_t there = LightTree::kLeaf | child.leaf;
            if (child.right != 0) {
                there = static_cast<std::uint32_t>(tree_.nodes.size());
                if (!gather(children[k], to, depth + 1)) return false;
            } else {
                const LightLeaf& leaf = leaves_[child.leaf];
                tree_.trails[tree_.first_trail[leaf.light] + (leaf.triangle == kWholeLight ? 0 : leaf.triangle)] =
                    to | std::uint64_t{1} << (LightTree::kTrailBits * (depth + 1));
            }
            tree_.nodes[index].child[k] = there;
        }
        return true;
    }

    void set(LightTree::Node& node, std::size_t k, const detail::Group& g) const {
        const NormalCone& cone = g.normals;
        const Vec3d middle = g.bounds.middle();
        for (int axis = 0; axis < 3; ++axis) {
            // The box around the rounded middle, and the rounding of what is computed from it.
            const auto c = static_cast<float>(detail::axis_of(middle, axis));
            const double reach = std::max(detail::axis_of(g.bounds.hi, axis) - c, c - detail::axis_of(g.bounds.lo, axis));
            node.center[axis][k] = c;
            node.half[axis][k] = static_cast<float>(reach * tree_.scale * (1.0 + 1e-6));
            node.axis[axis][k] = axis == 0 ? cone.axis.x : axis == 1 ? cone.axis.y : cone.axis.z;
        }
        node.cos_normals[k] = cone.angle >= kPi ? -1.0f : std::min(1.0f, sincos_turns(cone.angle * (0.5f * kInvPi)).cos);
        node.intensity[k] = static_cast<float>(g.intensity / binary_[0].group.intensity);
    }

    LightTree& tree_;
    std::vector<LightLeaf> leaves_;
    std::vector<BinaryNode> binary_;
};

}  // namespace

LightTree build_light_tree(std::span<const LightLeaf> leaves, std::size_t light_count) {
    LightTree tree;
    double total = 0.0;
    tree.first_trail.assign(light_count + 1, 0);
    for (const LightLeaf& leaf : leaves) {
        total += leaf.intensity;
        ++tree.first_trail[leaf.light + 1];
    }
    // A light without leaves, the environment, keeps an entry too: everything may be asked for its probability.
    for (std::size_t i = 1; i <= light_count; ++i) tree.first_trail[i] = tree.first_trail[i - 1] + std::max(1u, tree.first_trail[i]);
    tree.trails.assign(tree.first_trail.back(), 0);
    std::vector<LightLeaf> chosen;
    for (const LightLeaf& leaf : leaves) {
        if (!(leaf.intensity > 0.0)) continue;
        chosen.push_back(leaf);
        chosen.back().intensity = std::max(leaf.intensity, kFaintest * total);
    }
    // The most uneven trees that were met had 9 levels; should one have more than there is room for, halves have log8 n.
    for (const int halves_from : {30, 0}) {
        tree.nodes.clear();
        tree.leaves.clear();
        if (chosen.empty() || Builder(tree, chosen, halves_from).build()) break;
    }
    return tree;
}

}  // namespace koksma
