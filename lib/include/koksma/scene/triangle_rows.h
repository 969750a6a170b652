#pragma once
// Triangles as the batch kernel reads them: all that a hit asks for in one line of the cache, two with what is interpolated.

#include <koksma/math/vec3.h>
#include <koksma/scene/huge_pages.h>

#include <cstdint>

namespace koksma {

struct Scene;

struct alignas(64) TriangleRow {
    Vec3f v0, v1, v2;
    Vec3f ng;                    ///< normal_of_triangle: unit, before it may be turned
    std::uint32_t flags = 0;     ///< its bytes: 1 for a needle (is_needle); then flip, has_normals, has_uvs of its GeometryRecord
    std::uint32_t material = 0;  ///< of its GeometryRecord
    std::int32_t light = -1;
};

/// What its vertices carry; zero where they do not.
struct alignas(64) ShadingRow {
    Vec3f n0, n1, n2;
    Vec2f uv0, uv1, uv2;
};

static_assert(sizeof(TriangleRow) == 64 && sizeof(ShadingRow) == 64);

/// One for each entry of Scene::triangles.
[[nodiscard]] LargeVector<TriangleRow> triangle_rows(const Scene& scene);

/// The same; none if the scene asks neither for shading normals nor for texture coordinates.
[[nodiscard]] LargeVector<ShadingRow> shading_rows(const Scene& scene);

}  // namespace koksma
