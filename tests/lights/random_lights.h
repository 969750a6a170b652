#pragma once
// Sets of lights and points to try a light tree on.

#include <scenes/uniform.h>

#include <koksma/sampling/warps.h>
#include <koksma/scene/light_tree.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace koksma::testing {

[[nodiscard]] inline Vec3f random_unit(Uniform& u) { return square_to_sphere(u.pair()); }
[[nodiscard]] inline Vec3f random_in_cube(Uniform& u) { return {2 * u() - 1, 2 * u() - 1, 2 * u() - 1}; }

/// One kind of crowd.
enum class Crowd { points, triangles, all_kinds, plane, one_place, two_clusters, powers_of_ten, line };
inline constexpr Crowd kCrowds[] = {Crowd::points, Crowd::triangles, Crowd::all_kinds, Crowd::plane, Crowd::one_place, Crowd::two_clusters,
                                    Crowd::powers_of_ten, Crowd::line};

/// n lights in a cube of half side `size` around `middle`; every tenth is dark.
[[nodiscard]] inline std::vector<LightLeaf> random_leaves(Crowd crowd, std::uint32_t n, std::uint32_t seed, double size = 1.0, Vec3d middle = {}) {
    Uniform u(seed);
    std::vector<LightLeaf> out;
    for (std::uint32_t i = 0; i < n; ++i) {
        LightLeaf leaf;
        leaf.light = i;
        Vec3d c = to_double(random_in_cube(u));
        double half = 0.02 * u();
        leaf.normals = {random_unit(u), 0.0f};
        leaf.intensity = u() + 0.01;
        switch (crowd) {
            case Crowd::points: half = 0; leaf.normals.angle = 4.0f; break;
            case Crowd::triangles: break;
            case Crowd::all_kinds:
                if (i % 3 == 0) half = 0;
                leaf.normals.angle = i % 3 == 0 ? 4.0f : i % 3 == 1 ? 0.0f : 2.0f * u();
                break;
            case Crowd::plane: c.y = half = 0; leaf.normals.axis = {0, -1, 0}; break;
            case Crowd::one_place: c = {0.3, 0.2, 0.1}; half = 0; leaf.normals.angle = 4.0f; break;
            case Crowd::two_clusters: c = c * 1e-4 + Vec3d(i % 2 == 0 ? 1.0 : -1.0, 0, 0); half *= 1e-5; break;
            case Crowd::powers_of_ten: leaf.intensity = std::pow(10.0, 24.0 * u() - 12.0); break;
            case Crowd::line: c.y = c.z = 0.5; c.x = std::pow(2.0, -20.0 * u()); half = 0; leaf.normals.angle = 4.0f; break;
        }
        leaf.lo = middle + (c - Vec3d(half)) * size;
        leaf.hi = middle + (c + Vec3d(half)) * size;
        if (i % 10 == 9) leaf.intensity = 0;
        out.push_back(leaf);
    }
    return out;
}

struct Place {
    Vec3f p, n;
};

/// Points among, on, near and far from the lights, with normals of all directions and along the axes.
[[nodiscard]] inline std::vector<Place> places(const std::vector<LightLeaf>& leaves, std::uint32_t seed, float size = 1.0f, Vec3f middle = {}) {
    Uniform u(seed);
    std::vector<Place> out;
    const auto add = [&](Vec3f p) {
        out.push_back({p, random_unit(u)});
        out.push_back({p, {0, 1, 0}});
        out.push_back({p, {0, -1, 0}});
    };
    add(middle);
    for (int i = 0; i < 40; ++i) {
        add(middle + random_in_cube(u) * size);
        add(middle + random_unit(u) * (10 * size));
        const LightLeaf& leaf = leaves[static_cast<std::size_t>(u() * static_cast<float>(leaves.size()))];
        const Vec3f on = to_float((leaf.lo + leaf.hi) * 0.5);
        add(on);
        add(on + random_unit(u) * (1e-6f * size));
        add(on + random_unit(u) * (1e-2f * size));
    }
    for (const float far : {1e3f, 1e6f, 1e12f, 1e18f}) add(middle + random_unit(u) * (far * size));
    for (const float y : {1.5f, -1.5f}) add(middle + Vec3f{0, y * size, 0});
    return out;
}

}  // namespace koksma::testing
