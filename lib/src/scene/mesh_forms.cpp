#include "mesh_forms.h"

#include <koksma/scene/surface.h>

#include <algorithm>

namespace koksma::detail {

namespace {

/// What float leaves of a unit vector, a few times over; files write six digits.
constexpr float kSameNormal = 0x1p-19f;
/// Error of a density that counts on equal halves.
constexpr double kSameHalves = 1e-6;

bool is_same(Vec3f a, Vec3f b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

bool are_flat(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<const TriangleIndices> triangles) noexcept {
    return std::all_of(triangles.begin(), triangles.end(), [&](const TriangleIndices& t) {
        const Vec3f ng = normal_of_triangle(positions[t[0]], positions[t[1]], positions[t[2]]);
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return max_component(abs(normals[v] - ng)) <= kSameNormal; });
    });
}

bool make_parallelogram(std::span<const Vec3f> positions, std::span<TriangleIndices> triangles) noexcept {
    if (triangles.size() != 2) return false;
    TriangleIndices first = triangles[0], second = triangles[1];
    for (int i = 0; i < 3; ++i, std::rotate(first.begin(), first.begin() + 1, first.end()))
        for (int j = 0; j < 3; ++j, std::rotate(second.begin(), second.begin() + 1, second.end())) {
            if (!is_same(positions[first[0]], positions[second[0]]) || !is_same(positions[first[2]], positions[second[1]])) continue;
            const Vec3d a = to_double(positions[first[0]]), b = to_double(positions[first[1]]), c = to_double(positions[first[2]]),
                        d = to_double(positions[second[2]]);
            if (!(length(a + c - b - d) <= kSameHalves * std::min(length(b - a), length(d - a)))) continue;
            triangles[0] = first;
            triangles[1] = second;
            return true;
        }
    return false;
}

}  // namespace koksma::detail
