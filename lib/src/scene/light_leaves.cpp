#include <koksma/scene/light_tree.h>

#include "compile.h"

#include <algorithm>
#include <cmath>

namespace koksma::detail {

namespace {

/// Below, a light has no area that a float could divide by.
constexpr float kSmallestArea = 1e-37f;

constexpr NormalCone kAllNormals{{0.0f, 0.0f, 1.0f}, 4.0f};

/// The normals with which a triangle emits: emission asks the interpolated ones. They stay within the cone of the corners' as long
/// as that is below a quarter turn; beyond, they may be any.
NormalCone emission_normals(const Scene& scene, const GeometryRecord& g, const std::array<std::uint32_t, 3>& t, Vec3d area) {
    const float sign = g.flip ? -1.0f : 1.0f;
    const Vec3f ng = to_float(area * (1.0 / length(area))) * sign;
    if (!g.has_normals) return {ng, 0.0f};
    NormalCone cone{ng, 0.0f};
    bool first = true;
    for (const std::uint32_t v : t) {
        const Vec3f n = scene.normals[v];
        const NormalCone corner{dot(n, n) > 0.0f ? n * sign : ng, 0.0f};
        cone = first ? corner : unite(cone, corner);
        first = false;
    }
    return cone.angle < 1.57f ? cone : kAllNormals;
}

void add_triangles(std::vector<LightLeaf>& leaves, const Scene& scene, std::uint32_t index, double radiance) {
    const Light& light = scene.lights[index];
    const GeometryRecord& g = scene.geometries[light.geometry];
    for (std::uint32_t k = 0; k < light.triangles.size(); ++k) {
        const auto& t = scene.triangles[g.first + k];
        LightLeaf leaf{index, k, {}, {}, {}, 0.0};
        const Vec3d v0 = to_double(scene.positions[t[0]]), v1 = to_double(scene.positions[t[1]]), v2 = to_double(scene.positions[t[2]]);
        leaf.lo = {std::min({v0.x, v1.x, v2.x}), std::min({v0.y, v1.y, v2.y}), std::min({v0.z, v1.z, v2.z})};
        leaf.hi = {std::max({v0.x, v1.x, v2.x}), std::max({v0.y, v1.y, v2.y}), std::max({v0.z, v1.z, v2.z})};
        const Vec3d area = cross(v1 - v0, v2 - v0);
        if (light.area_of(k) >= kSmallestArea) {
            leaf.normals = emission_normals(scene, g, t, area);
            leaf.intensity = 0.5 * length(area) * radiance;
        }
        leaves.push_back(leaf);
    }
}

LightLeaf whole_light(const Scene& scene, std::uint32_t index, double radiance) {
    const Light& light = scene.lights[index];
    LightLeaf leaf{index, kWholeLight, {}, {}, kAllNormals, radiance};
    if (light.kind == LightKind::point) {
        leaf.lo = leaf.hi = to_double(light.corner);
        return leaf;
    }
    if (light.kind == LightKind::spot || light.kind == LightKind::projector) {
        // All of its light goes where the leaf takes it to go: within a quarter turn of a normal.
        const Beam& beam = scene.beams[light.geometry];
        leaf.lo = leaf.hi = to_double(light.corner);
        leaf.normals = {beam.axis, std::max(0.0f, beam.cutoff - 1.57f)};
        return leaf;
    }
    const GeometryRecord& g = scene.geometries[light.geometry];
    Vec3d middle, half;
    leaf.intensity = radiance * light.area;
    if (light.kind == LightKind::sphere) {
        const AnalyticSphere& sphere = scene.spheres[g.first];
        middle = sphere.center;
        half = Vec3d(sphere.radius);
        leaf.intensity *= 0.25;  // it shows a disk, a quarter of its area
    } else if (light.kind == LightKind::cylinder) {
        const AnalyticCylinder& c = scene.cylinders[g.first];
        middle = c.base + c.axis * 0.5;
        half = reach(c);
        leaf.intensity *= 1.0 / 3.141592653589793;  // it shows at most a rectangle, 1/pi of its area
    } else if (light.kind == LightKind::disk) {
        const AnalyticDisk& disk = scene.disks[g.first];
        const auto reach = [](double s, double t) { return std::sqrt(s * s + t * t); };
        const Vec3d n = cross(disk.s, disk.t);
        middle = disk.center;
        half = {reach(disk.s.x, disk.t.x), reach(disk.s.y, disk.t.y), reach(disk.s.z, disk.t.z)};
        leaf.normals = {to_float(n * ((g.flip ? -1.0 : 1.0) / length(n))), 0.0f};
    } else {
        // The first triangle of a parallelogram is one half of it.
        const auto& t = scene.triangles[g.first];
        const Vec3d v0 = to_double(scene.positions[t[0]]), v1 = to_double(scene.positions[t[1]]), v2 = to_double(scene.positions[t[2]]);
        const Vec3d n = cross(v1 - v0, v2 - v0);
        const auto reach = [](double a, double b) { return 0.5 * (std::fabs(a) + std::fabs(b)); };
        middle = (v0 + v2) * 0.5;
        half = {reach((v1 - v0).x, (v2 - v1).x), reach((v1 - v0).y, (v2 - v1).y), reach((v1 - v0).z, (v2 - v1).z)};
        // Float may have drawn the corners of a tiny light together: then no normal is known.
        if (length(n) > 0.0) leaf.normals = {to_float(n * ((g.flip ? -1.0 : 1.0) / length(n))), 0.0f};
    }
    leaf.lo = middle - half;
    leaf.hi = middle + half;
    return leaf;
}

}  // namespace

std::vector<LightLeaf> light_leaves(const Scene& scene, std::span<const double> radiances) {
    std::vector<LightLeaf> leaves;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (scene.lights[i].kind == LightKind::environment || scene.lights[i].kind == LightKind::directional) continue;
        if (scene.lights[i].kind == LightKind::mesh)
            add_triangles(leaves, scene, i, radiances[i]);
        else
            leaves.push_back(whole_light(scene, i, radiances[i]));
    }
    return leaves;
}

}  // namespace koksma::detail
