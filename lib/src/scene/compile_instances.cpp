#include <koksma/sampling/error.h>
#include <koksma/scene/animation.h>

#include "compile.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace koksma::detail {

namespace {

constexpr double kLargestCoordinate = 2e12;  // as of vertices

void check(const Animation& animation, const SourceLocation& where) {
    for (std::size_t i = 0; i < animation.size(); ++i) {
        const double det = glm::determinant(glm::dmat3(animation[i].to_world));
        if (!(det != 0.0) || !std::isfinite(1.0 / det)) throw Error(where.text() + ": a placement of the animation is singular");
        if (i > 0 && !(animation[i].time > animation[i - 1].time))
            throw Error(where.text() + ": the times of an animation must increase, found " + std::to_string(animation[i].time) + " after " +
                        std::to_string(animation[i - 1].time));
    }
}

std::vector<glm::dmat4> placements(const glm::dmat4& to_world, const Animation& animation, const Camera& camera,
                                   const SourceLocation& where) {
    if (animation.empty()) return {to_world};
    check(animation, where);
    return sampled(animation, camera.shutter_open, camera.shutter_close);
}

Placement as_floats(const glm::dmat4& m) {
    const auto column = [&](int c) { return Vec3d{static_cast<float>(m[c].x), static_cast<float>(m[c].y), static_cast<float>(m[c].z)}; };
    return {column(0), column(1), column(2), column(3)};
}

/// The larger of two, entry by entry. Neither has negative ones.
Placement larger(const Placement& a, const Placement& b) {
    const auto most = [](Vec3d u, Vec3d v) { return Vec3d{std::max(u.x, v.x), std::max(u.y, v.y), std::max(u.z, v.z)}; };
    return {most(a.x, b.x), most(a.y, b.y), most(a.z, b.z), most(a.t, b.t)};
}

}  // namespace

std::vector<std::vector<glm::dmat4>> settle(SceneDescription& d) {
    if (!(d.camera.shutter_close >= d.camera.shutter_open) || !std::isfinite(d.camera.shutter_close - d.camera.shutter_open))
        throw Error(d.camera.where.text() + ": the shutter closes at " + std::to_string(d.camera.shutter_close) + ", before it opens");
    std::vector<std::vector<glm::dmat4>> all;
    for (const Instance& i : d.instances) all.push_back(placements(i.to_world, i.animation, d.camera, i.where));
    std::vector<Shape> still;
    for (Shape& s : d.shapes) {
        std::vector<glm::dmat4> steps = placements(s.to_world, s.animation, d.camera, s.where);
        s.animation.clear();
        s.to_world = steps.front();
        if (steps.size() == 1) {
            still.push_back(std::move(s));
            continue;
        }
        if (s.emission) throw Error(s.emission->where.text() + ": a shape that moves while the shutter is open cannot emit");
        // The group has the shape where it is first, so that mirrors and normals are as of a shape at rest.
        const glm::dmat4 from_first = glm::inverse(s.to_world);
        for (glm::dmat4& m : steps) m = m * from_first;
        steps.front() = glm::dmat4(1.0);
        d.instances.push_back({static_cast<std::uint32_t>(d.groups.size()), {}, {}, s.where});
        const SourceLocation where = s.where;
        const std::string id = s.id;
        std::vector<Shape> one;
        one.push_back(std::move(s));
        d.groups.push_back({id, std::move(one), where});
        all.push_back(std::move(steps));
    }
    d.shapes = std::move(still);
    return all;
}

void compile_instances(Scene& scene, const std::vector<std::vector<glm::dmat4>>& placements, glm::dvec3 origin) {
    scene.first_instance = static_cast<std::uint32_t>(scene.description.shapes.size());
    double reach = 0.0;
    for (std::size_t i = 0; i < placements.size(); ++i) {
        const Instance& instance = scene.description.instances[i];
        const GroupRecord& group = scene.groups[instance.group];
        InstanceRecord record;
        record.first_geometry = group.first_geometry;
        record.first_placement = static_cast<std::uint32_t>(scene.placements.size());
        record.placement_count = static_cast<std::uint32_t>(placements[i].size());
        double sign = 0.0;
        Placement most{{}, {}, {}, {}};
        for (const glm::dmat4& to_world : placements[i]) {
            glm::dmat4 m = to_world;
            m[3] = to_world * glm::dvec4(group.origin.x, group.origin.y, group.origin.z, 1.0) - glm::dvec4(origin, 0.0);
            const Placement p = as_floats(m);
            const double det = determinant(p);
            if (!(std::fabs(det) > 1e-30) || !std::isfinite(1.0 / det)) throw Error(instance.where.text() + ": the placement is singular");
            if (sign * det < 0.0) throw Error(instance.where.text() + ": the motion turns a mirror image into another");
            sign = det;
            const double size = length(p.t) + group.radius * std::sqrt(dot(p.x, p.x) + dot(p.y, p.y) + dot(p.z, p.z));
            if (!(size <= kLargestCoordinate))
                throw Error(instance.where.text() + ": an instance reaches farther from the camera than 2e12, or is not finite");
            reach = std::max(reach, size);
            record.error.matrix = larger(record.error.matrix, placement_error(p).matrix);
            most = larger(most, {abs(p.x), abs(p.y), abs(p.z), abs(p.t)});
            scene.placements.push_back(p);
        }
        if (record.placement_count == 1) {
            record.to_own = inverse(scene.placements.back());
        } else {
            // In between, Embree interpolates in float: a few roundings of each entry, and of the instant. From one placement to the next
            // the inverse changes by less than twice.
            Placement& m = record.error.matrix;
            for (Vec3d* column : {&m.x, &m.y, &m.z}) *column = *column * 2.0;
            record.error.constant = (bound_by(most, Vec3d(group.radius)) + most.t) * 0x1p-20;
            scene.effects |= {Effect::motion};
        }
        scene.instances.push_back(record);
        scene.effects |= {Effect::instancing};
    }
    scene.bounding_radius = std::max(scene.bounding_radius, static_cast<float>(reach));
}

}  // namespace koksma::detail
