#include <koksma/sampling/error.h>

#include "compile.h"
#include "mesh_forms.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koksma::detail {

namespace {

/// Embree multiplies three coordinates: beyond this they overflow and hits are lost in silence (measured from 7e12 on).
constexpr float kLargestCoordinate = 2e12f;

/// Corners in circular order, so that the unit square maps onto the two triangles without a seam (light sampling).
MeshData rectangle_mesh() {
    return {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// Four vertices a face, each face with the whole unit square of UVs, oriented as Mitsuba's cube.
MeshData cube_mesh() {
    constexpr float kCorners[6][4][3] = {
        {{1, -1, -1}, {1, -1, 1}, {-1, -1, 1}, {-1, -1, -1}}, {{1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}},
        {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}},     {{1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}},
        {{-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, {-1, -1, -1}}, {{1, 1, -1}, {1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}}};
    MeshData mesh;
    for (const auto& face : kCorners) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const auto& c : face) mesh.positions.emplace_back(c[0], c[1], c[2]);
        for (const glm::vec2 uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) mesh.uvs.push_back(uv);
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first + 3, first, first + 2});
    }
    return mesh;
}

class ShapeCompiler {
public:
    ShapeCompiler(Scene& scene, const Shape& shape, glm::dvec3 origin) : scene_(scene), shape_(shape), origin_(origin) {}

    void operator()(const MeshShape& m) { add_mesh(*m.data); }
    void operator()(const RectangleShape&) { add_mesh(rectangle_mesh()); }
    void operator()(const CubeShape&) { add_mesh(cube_mesh()); }
    void operator()(const DiskShape&) {
        const glm::dmat4& m = shape_.to_world;
        AnalyticDisk disk{vec(glm::dvec3(m[3]) - origin_), vec(glm::dvec3(m[0])), vec(glm::dvec3(m[1]))};
        if (!(length(cross(disk.s, disk.t)) > 0.0)) throw Error(shape_.where.text() + ": the disk has no area (its to_world is singular)");
        GeometryRecord g = record(GeometryKind::disk);
        g.flip = g.flip != (glm::dot(glm::cross(glm::dvec3(m[0]), glm::dvec3(m[1])), glm::transpose(glm::inverse(glm::dmat3(m)))[2]) < 0.0);
        g.first = static_cast<std::uint32_t>(scene_.disks.size());
        scene_.disks.push_back(disk);
        scene_.geometries.push_back(g);
        scene_.effects |= {Effect::analytic_shape};
    }
    void operator()(const SphereShape& s) {
        const glm::dmat4& m = shape_.to_world;
        const double scale = glm::length(glm::dvec3(m[0]));
        AnalyticSphere sphere{vec(glm::dvec3(m * glm::dvec4(s.center, 1.0)) - origin_), s.radius * scale};
        if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius))
            throw Error(shape_.where.text() + ": the sphere's radius is " + std::to_string(sphere.radius) + "; it must be positive");
        GeometryRecord g = record(GeometryKind::sphere);
        g.flip = g.flip != (glm::determinant(glm::dmat3(m)) < 0.0);
        g.first = static_cast<std::uint32_t>(scene_.spheres.size());
        scene_.spheres.push_back(sphere);
        scene_.geometries.push_back(g);
        scene_.effects |= {Effect::analytic_shape};
    }

    void operator()(const CylinderShape& c) {
        const glm::dmat4& m = shape_.to_world;
        const glm::dvec3 p0(m * glm::dvec4(c.p0, 1.0)), axis = glm::dmat3(m) * (c.p1 - c.p0);
        // A frame about the axis in its own space. To the world it comes by a similarity, so it stays a frame.
        const glm::dvec3 own = glm::normalize(c.p1 - c.p0);
        const auto [s, t] = frame_about(own);
        const glm::dvec3 world_s = glm::dmat3(m) * s, world_t = glm::dmat3(m) * t;
        AnalyticCylinder cylinder{vec(p0 - origin_), vec(axis), vec(glm::normalize(world_s)), vec(glm::normalize(world_t)),
                                  c.radius * glm::length(world_s)};
        if (!(cylinder.radius > 0.0) || !std::isfinite(cylinder.radius) || !(glm::length(axis) > 0.0))
            throw Error(shape_.where.text() + ": a cylinder needs a positive radius and a length");
        GeometryRecord g = record(GeometryKind::cylinder);
        // Unlike a sphere's, a mirrored cylinder's normals stay outside: so it is in Mitsuba.
        g.first = static_cast<std::uint32_t>(scene_.cylinders.size());
        scene_.cylinders.push_back(cylinder);
        scene_.geometries.push_back(g);
        scene_.effects |= {Effect::analytic_shape};
    }

private:
    /// Mitsuba's frame about a unit vector, whose first axis is where a cylinder's u begins.
    /// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1)
    static std::pair<glm::dvec3, glm::dvec3> frame_about(const glm::dvec3& n) {
        const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
        return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
    }
    static Vec3d vec(glm::dvec3 v) { return {v.x, v.y, v.z}; }

    GeometryRecord record(GeometryKind kind) const {
        GeometryRecord g;
        g.kind = kind;
        g.flip = shape_.flip_normals;
        g.material = shape_.material;
        return g;
    }

    void add_mesh(const MeshData& mesh) {
        GeometryRecord g = record(GeometryKind::mesh);
        const glm::dmat4& m = shape_.to_world;
        const glm::dmat3 linear(m);
        const double det = glm::determinant(linear);
        if (!(det != 0.0) || !std::isfinite(det)) throw Error(shape_.where.text() + ": the shape's to_world is singular");
        // A mirroring transform turns the winding over. Normals that come with a shape are transformed as normals and do not
        // turn; a faceted mesh has none but the winding. This is Mitsuba's behaviour.
        g.flip = g.flip != (det < 0.0 && !std::holds_alternative<MeshShape>(shape_.geometry));
        g.first = static_cast<std::uint32_t>(scene_.triangles.size());
        g.has_uvs = !mesh.uvs.empty();
        g.has_normals = !mesh.normals.empty() && !shape_.face_normals;
        const auto base = static_cast<std::uint32_t>(scene_.positions.size());
        for (const glm::vec3& p : mesh.positions) {
            scene_.positions.push_back(Vec3f(glm::vec3(glm::dvec3(m * glm::dvec4(glm::dvec3(p), 1.0)) - origin_)));
            if (!(max_component(abs(scene_.positions.back())) <= kLargestCoordinate))
                throw Error(shape_.where.text() + ": a vertex is farther from the camera than 2e12, or not finite; scale the scene down");
        }
        for (const auto& t : mesh.triangles) scene_.triangles.push_back({base + t[0], base + t[1], base + t[2]});
        const auto triangles = std::span(scene_.triangles).subspan(g.first);
        if (shape_.emission) static_cast<void>(make_parallelogram(scene_.positions, triangles));
        if (g.has_uvs) {
            scene_.uvs.resize(base);
            scene_.uvs.insert(scene_.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
        }
        if (g.has_normals) {
            scene_.normals.resize(base);
            const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
            for (const glm::vec3& n : mesh.normals) {
                const glm::dvec3 v = normal_matrix * glm::dvec3(n);
                const double len = glm::length(v);
                scene_.normals.push_back(len > 0.0 ? Vec3f(glm::vec3(v / len)) : Vec3f(0.0f));
            }
            g.has_normals = !are_flat(scene_.positions, scene_.normals, triangles);
            if (g.has_normals) scene_.effects |= {Effect::shading_normals};
        }
        add_attributes(mesh, g, base);
        scene_.geometries.push_back(g);
    }

    /// Values of this mesh for the textures that look them up.
    void add_attributes(const MeshData& mesh, const GeometryRecord& g, std::uint32_t base) {
        for (std::size_t i = 0; i < scene_.attribute_slots.size(); ++i) {
            const AttributeSlot& slot = scene_.attribute_slots[i];
            if (slot.index < 0) continue;
            const std::string& name = std::get<MeshAttributeTexture>(scene_.textures[i]).name;
            const auto found =
                std::find_if(mesh.attributes.begin(), mesh.attributes.end(), [&](const MeshAttribute& a) { return a.name == name; });
            if (found == mesh.attributes.end()) continue;
            std::vector<Vec3f>& values = scene_.attributes[static_cast<std::size_t>(slot.index)];
            values.resize(slot.per_face ? g.first : base);
            values.insert(values.end(), found->values.begin(), found->values.end());
        }
    }

    Scene& scene_;
    const Shape& shape_;
    glm::dvec3 origin_;
};

}  // namespace

namespace {

/// Somewhere among the shapes of a group, so that their coordinates are small.
glm::dvec3 middle_of(const ShapeGroup& group) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Shape& s : group.shapes) {
        const auto grow = [&](glm::dvec3 p) {
            p = glm::dvec3(s.to_world * glm::dvec4(p, 1.0));
            low = glm::min(low, p);
            high = glm::max(high, p);
        };
        if (const auto* mesh = std::get_if<MeshShape>(&s.geometry)) {
            for (const glm::vec3& v : mesh->data->positions) grow(v);
        } else if (const auto* sphere = std::get_if<SphereShape>(&s.geometry)) {
            grow(sphere->center);
        } else if (const auto* cylinder = std::get_if<CylinderShape>(&s.geometry)) {
            grow(cylinder->p0), grow(cylinder->p1);
        } else {
            grow(glm::dvec3(0.0));
        }
    }
    return (low + high) * 0.5;
}

void compile_group(Scene& scene, const ShapeGroup& group) {
    GroupRecord record;
    record.first_geometry = static_cast<std::uint32_t>(scene.geometries.size());
    record.geometry_count = static_cast<std::uint32_t>(group.shapes.size());
    const glm::dvec3 middle = middle_of(group);
    record.origin = {middle.x, middle.y, middle.z};
    const GeometryCounts before{scene.positions.size(), scene.spheres.size(), scene.disks.size(), scene.cylinders.size()};
    for (const Shape& shape : group.shapes) {
        if (shape.emission) throw Error(shape.emission->where.text() + ": a shape of a group cannot emit");
        const Caller caller(scene, shape.where);
        std::visit(ShapeCompiler(scene, shape, middle), shape.geometry);
    }
    record.radius = radius_from(scene, before);
    scene.groups.push_back(record);
}

}  // namespace

double radius_from(const Scene& scene, GeometryCounts first) {
    double r2 = 0.0;
    const auto grow = [&](Vec3d p, double radius) {
        const double d = length(p) + radius;
        if (d * d > r2) r2 = d * d;
    };
    for (std::size_t i = first.positions; i < scene.positions.size(); ++i) grow(to_double(scene.positions[i]), 0.0);
    for (std::size_t i = first.spheres; i < scene.spheres.size(); ++i) grow(scene.spheres[i].center, scene.spheres[i].radius);
    for (std::size_t i = first.disks; i < scene.disks.size(); ++i)
        grow(scene.disks[i].center, length(scene.disks[i].s) + length(scene.disks[i].t));
    for (std::size_t i = first.cylinders; i < scene.cylinders.size(); ++i) {
        const AnalyticCylinder& c = scene.cylinders[i];
        grow(c.base, c.radius), grow(c.base + c.axis, c.radius);
    }
    return std::sqrt(r2);
}

void compile_shapes(Scene& scene, glm::dvec3 origin) {
    for (const Shape& shape : scene.description.shapes) {
        const Caller caller(scene, shape.where);
        std::visit(ShapeCompiler(scene, shape, origin), shape.geometry);
    }
    const double radius = radius_from(scene, {});
    scene.bounding_radius = radius > 0.0 ? static_cast<float>(radius) : 1.0f;
    for (const ShapeGroup& group : scene.description.groups) compile_group(scene, group);
    // Arrays are parallel where they are used: pad the shorter ones to the vertex count.
    if (!scene.uvs.empty()) scene.uvs.resize(scene.positions.size());
    if (!scene.normals.empty()) scene.normals.resize(scene.positions.size(), Vec3f(0.0f));
    // A shape without the attribute that its material looks up was refused with the materials.
    for (std::size_t i = 0; i < scene.attribute_slots.size(); ++i)
        if (const AttributeSlot& slot = scene.attribute_slots[i]; slot.index >= 0)
            scene.attributes[static_cast<std::size_t>(slot.index)].resize(slot.per_face ? scene.triangles.size() : scene.positions.size(),
                                                                          Vec3f(0.0f));
}

}  // namespace koksma::detail
