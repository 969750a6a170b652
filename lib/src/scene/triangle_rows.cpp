#include <koksma/scene/surface.h>
#include <koksma/scene/triangle_rows.h>

#include <algorithm>

namespace koksma {

namespace {

/// Calls f(geometry, triangle) for all triangles in their order. Meshes lie one behind the other.
template <class F>
void for_triangles(const Scene& scene, F&& f) {
    const GeometryRecord* mesh = nullptr;
    auto next = scene.geometries.begin();
    const auto is_mesh = [](const GeometryRecord& g) { return g.kind == GeometryKind::mesh; };
    const auto advance = [&] { next = std::find_if(next, scene.geometries.end(), is_mesh); };
    advance();
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        while (next != scene.geometries.end() && next->first <= t) {
            mesh = &*next++;
            advance();
        }
        f(*mesh, t);
    }
}

}  // namespace

LargeVector<TriangleRow> triangle_rows(const Scene& scene) {
    LargeVector<TriangleRow> rows(scene.triangles.size());
    for_triangles(scene, [&](const GeometryRecord& g, std::size_t t) {
        TriangleRow& row = rows[t];
        const auto& index = scene.triangles[t];
        row.v0 = scene.positions[index[0]];
        row.v1 = scene.positions[index[1]];
        row.v2 = scene.positions[index[2]];
        row.ng = normal_of_triangle(row.v0, row.v1, row.v2);
        row.flags = (is_needle(row.v0, row.v1, row.v2) ? 1u : 0u) | (g.flip ? 1u << 8 : 0u) | (g.has_normals ? 1u << 16 : 0u) | (g.has_uvs ? 1u << 24 : 0u);
        row.material = g.material;
        row.light = g.light;
    });
    return rows;
}

LargeVector<ShadingRow> shading_rows(const Scene& scene) {
    if (!scene.effects.has(Effect::shading_normals) && !scene.effects.has(Effect::texture) && !scene.effects.has(Effect::anisotropic)) return {};
    LargeVector<ShadingRow> rows(scene.triangles.size());
    for_triangles(scene, [&](const GeometryRecord& g, std::size_t t) {
        ShadingRow& row = rows[t];
        const auto& index = scene.triangles[t];
        if (g.has_normals) row.n0 = scene.normals[index[0]], row.n1 = scene.normals[index[1]], row.n2 = scene.normals[index[2]];
        const auto uv = [&](int i) { return Vec2f{scene.uvs[index[i]].x, scene.uvs[index[i]].y}; };
        if (g.has_uvs) row.uv0 = uv(0), row.uv1 = uv(1), row.uv2 = uv(2);
    });
    return rows;
}

}  // namespace koksma
