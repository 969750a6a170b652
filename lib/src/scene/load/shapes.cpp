#include "shapes.h"

#include "bsdfs.h"
#include "emitters.h"
#include "fail.h"
#include "files.h"
#include "media.h"
#include "mesh.h"
#include "transforms.h"

#include <koksma/scene/load.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace koksma::loader {
namespace {

/// @param index  of a mesh in a serialized file
MeshFile& mesh_file(const std::filesystem::path& file, const std::string& type, std::int64_t index, const SourceLocation& where,
                    Context& context) {
    MeshFile& mesh = context.meshes[file.string() + '@' + std::to_string(index)];
    if (mesh.as_written) return mesh;
    try {
        mesh.as_written = std::make_shared<const MeshData>(type == "obj"   ? load_obj(file)
                                                           : type == "ply" ? load_ply(file)
                                                                           : load_serialized(file, static_cast<std::uint32_t>(index)));
    } catch (const Error& e) {
        fail(where, "{}", e.what());
    }
    return mesh;
}

std::shared_ptr<const MeshData> with_uv(MeshFile& file, bool flip) {
    if (!flip || file.as_written->uvs.empty()) return file.as_written;
    if (!file.flipped_uv) {
        auto copy = std::make_shared<MeshData>(*file.as_written);
        for (auto& uv : copy->uvs) uv.y = 1.0f - uv.y;
        file.flipped_uv = std::move(copy);
    }
    return file.flipped_uv;
}

std::shared_ptr<const MeshData> without_normals(MeshFile& file, bool flip) {
    auto mesh = with_uv(file, flip);
    if (mesh->normals.empty()) return mesh;
    auto& cached = file.no_normals[flip ? 1 : 0];
    if (!cached) {
        auto copy = std::make_shared<MeshData>(*mesh);
        copy->normals.clear();
        cached = std::move(copy);
    }
    return cached;
}

/// Normals that follow from the angles in world space are shared by all shapes whose transforms keep angles and orientation.
std::shared_ptr<const MeshData> with_normals(MeshFile& file, bool flip, const glm::dmat4& to_world) {
    auto mesh = with_uv(file, flip);
    if (!mesh->normals.empty()) return mesh;
    const bool shareable = is_similarity(to_world, 1e-6) && glm::determinant(glm::dmat3(to_world)) > 0.0;
    auto& cached = file.smooth[flip ? 1 : 0];
    if (shareable && cached) return cached;
    auto copy = std::make_shared<MeshData>(*mesh);
    copy->normals = smooth_normals(*mesh, shareable ? glm::dmat4(1.0) : to_world);
    if (shareable) cached = copy;
    return copy;
}

MeshShape read_mesh(Properties& p, const glm::dmat4& to_world, bool face_normals, Context& context) {
    const bool obj = p.type() == "obj";
    const std::int64_t index = p.type() == "serialized" ? p.integer("shape_index", 0, 0, std::numeric_limits<std::int32_t>::max()) : 0;
    const auto path = resolve(p.required_text("filename"), context.search, p.where("filename"));
    MeshFile& file = mesh_file(path, p.type(), index, p.where("filename"), context);
    const bool flip = p.boolean("flip_tex_coords", obj);  // OBJ counts v from the bottom, Mitsuba's images from the top
    return {face_normals || file.as_written->faceted ? without_normals(file, flip) : with_normals(file, flip, to_world)};
}

SphereShape read_sphere(Properties& p, const glm::dmat4& to_world) {
    SphereShape s;
    s.center = p.point("center", s.center);
    s.radius = p.number("radius", s.radius);
    if (!(s.radius > 0.0)) fail(p.where("radius"), "'radius' is {}; it must be positive", s.radius);
    // Matrices are often written with four digits.
    if (!is_similarity(to_world, 1e-4))
        fail(p.where("to_world"), "'to_world' of a sphere must scale all axes alike; use a mesh for an ellipsoid");
    return s;
}

CylinderShape read_cylinder(Properties& p, const glm::dmat4& to_world) {
    CylinderShape c;
    c.p0 = p.point("p0", c.p0);
    c.p1 = p.point("p1", c.p1);
    c.radius = p.number("radius", c.radius);
    if (!(c.radius > 0.0)) fail(p.where("radius"), "'radius' is {}; it must be positive", c.radius);
    const glm::dvec3 axis = c.p1 - c.p0;
    if (!(glm::dot(axis, axis) > 0.0)) fail(p.where("p1"), "a cylinder needs a length: 'p0' and 'p1' are the same point");
    if (!is_similarity(to_world, 1e-4))
        fail(p.where("to_world"), "'to_world' of a cylinder must scale all axes alike; use a mesh for a stretched one");
    return c;
}

Geometry read_geometry(Properties& p, const glm::dmat4& to_world, bool face_normals, Context& context) {
    if (p.type() == "rectangle") return RectangleShape{};
    if (p.type() == "disk") return DiskShape{};
    if (p.type() == "cube") return CubeShape{};
    if (p.type() == "sphere") return read_sphere(p, to_world);
    if (p.type() == "cylinder") return read_cylinder(p, to_world);
    return read_mesh(p, to_world, face_normals, context);
}

/// Corners of a box around the shape in its own space.
void bounds(const Geometry& geometry, glm::dvec3& low, glm::dvec3& high) {
    low = glm::dvec3(-1.0), high = glm::dvec3(1.0);
    if (const auto* sphere = std::get_if<SphereShape>(&geometry))
        low = sphere->center - sphere->radius, high = sphere->center + sphere->radius;
    if (const auto* c = std::get_if<CylinderShape>(&geometry))
        low = glm::min(c->p0, c->p1) - c->radius, high = glm::max(c->p0, c->p1) + c->radius;
    if (const auto* mesh = std::get_if<MeshShape>(&geometry)) {
        low = high = glm::dvec3(mesh->data->positions.front());
        for (const glm::vec3& v : mesh->data->positions)
            for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], double(v[k])), high[k] = std::max(high[k], double(v[k]));
    }
}

void check_placement(const Properties& p, const Geometry& geometry, const glm::dmat4& to_world) {
    const double determinant = glm::determinant(glm::dmat3(to_world));
    if (determinant == 0.0 || !std::isfinite(1.0 / determinant))
        fail(p.where("to_world"), "'to_world' of {} cannot be inverted; does it scale by 0?", p.type());
    glm::dvec3 low, high;
    bounds(geometry, low, high);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 own(corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y, corner & 4 ? low.z : high.z, 1.0);
        const glm::dvec4 world = to_world * own;
        if (!(std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) <= double(kMaxCoordinate)))
            fail(p.where("to_world"), "{} reaches beyond {} in world space", p.type(), kMaxCoordinate);
    }
}

const std::vector<std::string> kSimpleTypes{"obj", "ply", "serialized", "rectangle", "disk", "cube", "sphere", "cylinder"};

Shape parse_simple(Properties& p, Context& context) {
    Shape shape;
    shape.id = p.id();
    shape.where = p.where();
    shape.animation = p.placements("to_world");
    shape.to_world = shape.animation.front().to_world;
    shape.flip_normals = p.boolean("flip_normals", false);
    if (p.type() != "sphere" && p.type() != "disk" && p.type() != "cylinder") shape.face_normals = p.boolean("face_normals", false);
    shape.geometry = read_geometry(p, shape.to_world, shape.face_normals, context);
    const Element* bsdf = p.object("bsdf");
    const Element* emitter = p.object("emitter");
    const Element *interior = p.named_object("interior", "medium"), *exterior = p.named_object("exterior", "medium");
    p.finish();
    if (interior) shape.interior = medium_of(*interior, context);
    if (exterior) shape.exterior = medium_of(*exterior, context);
    for (const Keyframe& k : shape.animation) check_placement(p, shape.geometry, k.to_world);
    if (shape.animation.size() == 1) shape.animation.clear();
    if (emitter) shape.emission = read_area_emission(*emitter, context);
    shape.material = bsdf ? material_of(*bsdf, context) : emitter ? black_material(context) : 0;
    return shape;
}

/// The group's place in the scene; read when an instance first asks for it.
std::uint32_t group_of(const Element& element, Context& context) {
    const auto known = context.groups.find(&element);
    if (known != context.groups.end()) return known->second;
    ShapeGroup group = parse_group(element, context);
    const auto index = static_cast<std::uint32_t>(context.scene.groups.size());
    context.scene.groups.push_back(std::move(group));
    context.groups.emplace(&element, index);
    return index;
}

Instance parse_instance(Properties& p, Context& context) {
    Instance instance;
    instance.where = p.where();
    instance.animation = p.placements("to_world");
    instance.to_world = instance.animation.front().to_world;
    const Element* group = p.object("shape");
    p.finish();
    if (!group) fail(p.where(), "an instance needs a shapegroup, nested or by <ref>");
    if (group->required("type") != "shapegroup") fail(group->where, "an instance takes a shapegroup, found '{}'", group->required("type"));
    instance.group = group_of(*group, context);
    for (const Keyframe& k : instance.animation)
        for (const Shape& s : context.scene.groups[instance.group].shapes) check_placement(p, s.geometry, k.to_world * s.to_world);
    if (instance.animation.size() == 1) instance.animation.clear();
    return instance;
}

}  // namespace

ShapeGroup parse_group(const Element& element, Context& context) {
    Properties p(element, context.ids, {"shapegroup"});
    ShapeGroup group;
    group.id = p.id();
    group.where = p.where();
    const auto members = p.objects("shape");
    p.finish();
    if (members.empty()) fail(p.where(), "a shapegroup needs a shape");
    for (const Element* member : members) {
        const std::string& type = member->required("type");
        if (type == "instance" || type == "shapegroup")
            fail(member->where, "'{}' inside a shapegroup: groups are not nested, as in Mitsuba", type);
        Properties own(*member, context.ids, kSimpleTypes);
        if (own.is("to_world", "animation"))
            fail(own.where("to_world"), "a shape of a group cannot move on its own; animate its instances");
        Shape shape = parse_simple(own, context);
        if (shape.emission) fail(shape.emission->where, "a shape of a shapegroup cannot emit, as in Mitsuba");
        group.shapes.push_back(std::move(shape));
    }
    return group;
}

void read_shape(const Element& element, Context& context) {
    std::vector<std::string> types = kSimpleTypes;
    types.insert(types.end(), {"shapegroup", "instance"});
    Properties p(element, context.ids, types);
    if (p.type() == "shapegroup") return;
    if (p.type() == "instance")
        context.scene.instances.push_back(parse_instance(p, context));
    else
        context.scene.shapes.push_back(parse_simple(p, context));
}

}  // namespace koksma::loader
