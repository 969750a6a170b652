#include "light_binary.h"

#include <koksma/simd/elementary.h>

#include <array>
#include <cmath>

namespace koksma {

namespace detail {

namespace {

constexpr int kBins = 16;

[[nodiscard]] Group group_of(const LightLeaf& leaf) { return {{leaf.lo, leaf.hi}, leaf.normals, leaf.intensity, 1}; }

/// The solid angle into which a cone of normals shines, weighted by the cosine beyond the cone: pi for one normal, 4 pi for all.
/// Source: Conty Estevez & Kulla 2018, equation 1 with theta_e = pi / 2, integrated
[[nodiscard]] double solid_angle(const NormalCone& cone) {
    const SinCos o = sincos_turns(cone.angle * (0.5f * kInvPi));
    if (cone.angle <= 0.5f * kPi) return kPi * (2.0 - o.cos + 0.5 * kPi * o.sin);
    return kPi * (2.0 - 2.0 * o.cos + (kPi - cone.angle) * o.sin);
}

/// Source: Conty Estevez & Kulla 2018, section 4.4, with half the surface of the box. Boxes without area still differ in length.
[[nodiscard]] double cost(const Group& g) {
    const Vec3d s = g.bounds.size();
    return g.intensity * (s.x * s.y + s.y * s.z + s.z * s.x + 1e-6 * dot(s, s)) * solid_angle(g.normals);
}

class Splitter {
public:
    Splitter(std::vector<LightLeaf>& leaves, int halves_from) : leaves_(leaves), halves_from_(halves_from) { nodes_.reserve(2 * leaves.size()); }
    [[nodiscard]] std::vector<BinaryNode> take() { return std::move(nodes_); }

    /// Makes the binary tree over leaves [first, last). @return its root's index
    std::uint32_t halve(std::size_t first, std::size_t last, int depth) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        BinaryNode made;
        if (last - first == 1) {
            made.group = group_of(leaves_[first]);
            made.leaf = static_cast<std::uint32_t>(first);
        } else {
            const std::size_t middle = split(first, last, depth);
            made.left = halve(first, middle, depth + 1);
            made.right = halve(middle, last, depth + 1);
            made.group = nodes_[made.left].group;
            made.group.add(nodes_[made.right].group);
        }
        nodes_[index] = made;
        return index;
    }

private:
    /// Orders the leaves so that one child is [first, middle). @return middle
    std::size_t split(std::size_t first, std::size_t last, int depth) {
        Bounds centers;
        for (std::size_t i = first; i < last; ++i) centers.grow(center(leaves_[i]), center(leaves_[i]));
        const Vec3d size = centers.size();
        const double longest = max_component(size);
        const int widest = longest == size.x ? 0 : longest == size.y ? 1 : 2;
        if (!(longest > 0.0)) return first + (last - first) / 2;
        if (depth >= halves_from_) return halves(first, last, widest);

        double best = std::numeric_limits<double>::infinity();
        int best_axis = -1, best_bin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double lo = axis_of(centers.lo, axis), width = axis_of(size, axis);
            if (!(width > 0.0)) continue;
            std::array<Group, kBins> bins, above;
            for (std::size_t i = first; i < last; ++i) bins[bin(leaves_[i], axis, lo, width)].add(group_of(leaves_[i]));
            above[kBins - 1] = bins[kBins - 1];
            for (std::size_t b = kBins - 1; b-- > 0;) (above[b] = above[b + 1]).add(bins[b]);
            Group below;
            for (std::size_t b = 0; b + 1 < kBins; ++b) {
                below.add(bins[b]);
                if (below.count == 0 || above[b + 1].count == 0) continue;
                const double price = (cost(below) + cost(above[b + 1])) * (longest / width);  // thin boxes are dear
                if (price < best) best = price, best_axis = axis, best_bin = static_cast<int>(b);
            }
        }
        if (best_axis < 0) return halves(first, last, widest);
        const double lo = axis_of(centers.lo, best_axis), width = axis_of(size, best_axis);
        const auto at = [&](std::size_t i) { return leaves_.begin() + static_cast<std::ptrdiff_t>(i); };
        return static_cast<std::size_t>(std::stable_partition(at(first), at(last),
                                                              [&](const LightLeaf& leaf) {
                                                                  return bin(leaf, best_axis, lo, width) <= static_cast<std::size_t>(best_bin);
                                                              }) -
                                        leaves_.begin());
    }

    std::size_t halves(std::size_t first, std::size_t last, int axis) {
        const auto at = [&](std::size_t i) { return leaves_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::stable_sort(at(first), at(last), [&](const LightLeaf& a, const LightLeaf& b) { return axis_of(center(a), axis) < axis_of(center(b), axis); });
        return first + (last - first) / 2;
    }

    static Vec3d center(const LightLeaf& leaf) { return (leaf.lo + leaf.hi) * 0.5; }
    static std::size_t bin(const LightLeaf& leaf, int axis, double lo, double width) {
        return static_cast<std::size_t>(std::min(kBins - 1.0, (axis_of(center(leaf), axis) - lo) / width * kBins));
    }

    std::vector<LightLeaf>& leaves_;
    int halves_from_;
    std::vector<BinaryNode> nodes_;
};

}  // namespace

std::vector<BinaryNode> make_binary_tree(std::vector<LightLeaf>& leaves, int halves_from) {
    Splitter splitter(leaves, halves_from);
    splitter.halve(0, leaves.size(), 0);
    return splitter.take();
}

}  // namespace detail

NormalCone unite(const NormalCone& a, const NormalCone& b) noexcept {
    if (b.angle > a.angle) return unite(b, a);
    const float between = atan2_poly(length(cross(a.axis, b.axis)), dot(a.axis, b.axis));
    if (between + b.angle <= a.angle || a.angle >= kPi) return a;
    const float angle = 0.5f * (a.angle + between + b.angle) + 1e-6f;  // and the error of atan2_poly
    if (!(angle < kPi)) return {a.axis, kPi};
    const float cosine = dot(a.axis, b.axis);
    Vec3f side = b.axis - a.axis * cosine;
    const float len = length(side);
    // Of nearly opposite axes the difference is noise: any side will do, at the price of the noise.
    const bool opposite = cosine < 0.0f && len < 1e-3f;
    side = opposite ? Frame::from_normal(a.axis).s : side * (1.0f / len);
    const SinCos turn = sincos_turns((angle - a.angle) * (0.5f * kInvPi));
    return {normalize(a.axis * turn.cos + side * turn.sin), opposite ? angle + 2e-3f : angle};
}

}  // namespace koksma
