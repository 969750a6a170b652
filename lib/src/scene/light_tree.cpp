#include <koksma/sampling/bits.h>
#include <koksma/scene/light_tree.h>

#include <bit>
#include <cmath>

namespace koksma {

namespace {

/// Cosines of bounding angles carry errors of up to 5e-4 (a sine by sqrt(1 - cos^2), near zero): down to -kSlack they count as
/// +kSlack, so that rounding takes no light away.
constexpr float kSlack = 1e-3f;

/// The same for lengths, as a part of the distance.
constexpr float kLengthSlack = 1e-6f;

/// An estimate takes the cosine at the middle, but at least this part of the largest, and distance^2 + radius^2. Relative variance of
/// a choice in scenes/many-lights.xml and under a ceiling of 1000 lamps (test_lights "[measure]"): 0.97 and 0.021; with the
/// largest cosine instead 1.00 and 0.090; with the larger of distance and radius 1.05 and 0.014; with both 1.09 and 0.064.
constexpr float kBoundShare = 0.25f;

/// Nearer than this part of the lights' radius, importance grows no more.
constexpr float kNearest2 = 1e-18f;

constexpr float kFarthest = 1e9f;

/// A path down the tree less likely than this is no path: its reciprocal would overflow.
constexpr float kSmallestProbability = 1e-30f;

[[nodiscard]] float larger(float a, float b) noexcept { return a > b ? a : b; }
[[nodiscard]] float sine(float cosine) noexcept { return std::sqrt(larger(1.0f - cosine * cosine, 0.0f)); }
[[nodiscard]] float below_one(float u) noexcept { return u < kOneMinusUlp ? (u > 0.0f ? u : 0.0f) : kOneMinusUlp; }

/// In order of the lanes.
[[nodiscard]] float total(const LightTree::Lanes& lanes) noexcept {
    float sum = 0.0f;
    for (const float x : lanes) sum += x;
    return sum;
}

/// Lights at infinity get their share; all, where the tree has nothing to give.
[[nodiscard]] float distant_probability(const LightTree& tree, bool tree_can) noexcept {
    if (tree_can) return tree.distant_share;
    return tree.distant_share > 0.0f ? 1.0f : 0.0f;
}

/// One of the lights at infinity. @param share  probability that it is one of them
[[nodiscard]] LightChoice choose_distant(const LightTree& tree, float share, float u) noexcept {
    std::size_t k = 0;
    for (; k + 1 < tree.distant.size() && u >= tree.distant[k].probability; ++k) u -= tree.distant[k].probability;
    return {tree.distant[k].light, kWholeLight, share * tree.distant[k].probability, below_one(u / tree.distant[k].probability)};
}

}  // namespace

Vec3f LightTree::pulled(Vec3f p) const noexcept {
    const Vec3f d = p - origin;
    const float m = max_component(abs(d)) * scale;
    return m > kFarthest ? origin + d * (kFarthest / m) : p;
}

LightTree::Lanes LightTree::importance(const Node& node, Vec3f p, Vec3f n) const noexcept {
    Lanes out;
    const Vec3f an = abs(n);
    const float unit = scale;
    // No branches, and one choice at a time: so that compilers make vectors of it. What a lane has no use for is computed too.
    for (std::size_t k = 0; k < kWidth; ++k) {
        const Vec3f d = (Vec3f{node.center[0][k], node.center[1][k], node.center[2][k]} - p) * unit;
        const Vec3f half{node.half[0][k], node.half[1][k], node.half[2][k]}, axis{node.axis[0][k], node.axis[1][k], node.axis[2][k]};
        const float cos_o = node.cos_normals[k];
        const float d2 = dot(d, d), r2 = dot(half, half);
        const float distance = std::sqrt(larger(d2, kNearest2)), inverse = 1.0f / distance;

        // The corner highest above the horizon of p; and where all normals are one, the corner before which p lies farthest.
        const float toward = dot(n, d), away = -dot(axis, d);
        const float highest = toward + dot(an, half), foremost = away + dot(abs(axis), half);
        const float slack = -kLengthSlack * distance;
        const float before = cos_o < 1.0f ? 0.0f : foremost;

        // Angles to the middle, made smaller by what the sphere around the bounds, and then the cone of normals, may add.
        const float sin_u = std::sqrt(r2) * inverse, cos_u = std::sqrt(larger(d2 - r2, 0.0f)) * inverse;
        const float cos_surface = toward * inverse, cos_emission = away * inverse;
        const float surface_bent = cos_surface * cos_u + sine(cos_surface) * sin_u;
        const float surface = cos_surface >= cos_u ? 1.0f : surface_bent;
        const float sin_o = sine(cos_o);
        const float cos_ou = cos_o * cos_u - sin_o * sin_u, sin_ou = sin_o * cos_u + cos_o * sin_u;
        const float emission_bent = cos_emission * cos_ou + sine(cos_emission) * sin_ou;
        const float turned = cos_ou < 0.0f ? -2.0f : cos_ou;  // the two make half a turn or more: all directions are within
        const float edge = sin_ou > 0.0f ? cos_ou : turned;
        const float emission = cos_emission >= edge ? 1.0f : emission_bent;

        const float cosines = larger(larger(cos_surface, kBoundShare * surface), kSlack) * larger(emission, kSlack);
        const float outside = emission < -kSlack ? 0.0f : cosines;
        const float seen = d2 > r2 ? outside : 1.0f;  // within the sphere around the bounds any angle is possible
        const float estimate = node.intensity[k] * seen / larger(d2 + r2, kNearest2);
        const float risen = highest < slack ? 0.0f : estimate;
        out[k] = before < slack ? 0.0f : risen;
    }
    return out;
}

LightChoice LightTree::choose(Vec3f p, Vec3f n, float u) const noexcept {
    constexpr LightChoice kNone{0, kWholeLight, 0.0f, 0.0f};
    const Vec3f q = pulled(p);
    Lanes lanes = nodes.empty() ? Lanes{} : importance(nodes[0], q, n);
    float sum = total(lanes);
    const float share = distant_probability(*this, sum > 0.0f);
    if (u < share) return choose_distant(*this, share, below_one(u / share));
    float probability = 1.0f - share;
    if (share > 0.0f) u = below_one((u - share) / probability);
    for (std::uint32_t node = 0; sum > 0.0f;) {
        // The first lane whose prefix sum is above x: u < 1 keeps x below the sum, and lanes of zero are passed over.
        const float x = u * sum;
        float below = 0.0f, begin = 0.0f;
        std::size_t taken = 0;
        for (std::size_t k = 0; k + 1 < kWidth; ++k) {
            below += lanes[k];
            taken += x >= below ? 1 : 0;
            begin = x >= below ? below : begin;
        }
        probability *= lanes[taken] / sum;
        if (!(probability > kSmallestProbability)) break;
        u = below_one((x - begin) / lanes[taken]);
        const std::uint32_t child = nodes[node].child[taken];
        if ((child & kLeaf) != 0) return {leaves[child & ~kLeaf].light, leaves[child & ~kLeaf].triangle, probability, u};
        node = child;
        lanes = importance(nodes[node], q, n);
        sum = total(lanes);
    }
    return kNone;
}

float LightTree::probability(std::uint32_t light, std::uint32_t triangle, Vec3f p, Vec3f n) const noexcept {
    const Vec3f q = pulled(p);
    Lanes lanes = nodes.empty() ? Lanes{} : importance(nodes[0], q, n);
    float sum = total(lanes);
    const float share = distant_probability(*this, sum > 0.0f);
    if (distant_share > 0.0f)
        for (const Distant& d : distant)
            if (d.light == light) return share * d.probability;
    float probability = 1.0f - share;
    std::uint64_t trail = trails[first_trail[light] + (triangle == kWholeLight ? 0 : triangle)];
    for (std::uint32_t node = 0; trail != 0 && sum > 0.0f;) {
        const std::size_t taken = trail & (kWidth - 1);
        probability *= lanes[taken] / sum;
        if (!(probability > kSmallestProbability)) break;
        trail >>= kTrailBits;
        if (trail == 1) return probability;
        node = nodes[node].child[taken];
        lanes = importance(nodes[node], q, n);
        sum = total(lanes);
    }
    return 0.0f;
}

int LightTree::depth(std::uint32_t light, std::uint32_t triangle) const noexcept {
    return static_cast<int>(std::bit_width(trails[first_trail[light] + (triangle == kWholeLight ? 0 : triangle)])) / kTrailBits;
}

}  // namespace koksma
