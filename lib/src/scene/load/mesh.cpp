#include "mesh.h"

#include "fail.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace koksma::loader {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Angle between two vectors, accurate near 0 and pi as well. Source: Kahan, "How Futile are Mindless Assessments of Roundoff", sec. 12
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 p = a * glm::length(b), q = b * glm::length(a);
    return 2.0 * std::atan2(glm::length(p - q), glm::length(p + q));
}

}  // namespace

void check_mesh(const MeshData& mesh, const std::filesystem::path& file) {
    const std::string name = file.string();
    if (mesh.triangles.empty()) throw Error(name + ": the mesh has no triangle");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (!finite(p)) throw Error(fmt::format("{}: vertex {} is {} {} {}; it must be finite", name, i, p.x, p.y, p.z));
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kMaxCoordinate)
            throw Error(fmt::format("{}: vertex {} is {} {} {}; coordinates must be at most {}", name, i, p.x, p.y, p.z, kMaxCoordinate));
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        if (!finite(mesh.normals[i]) || mesh.normals[i] == glm::vec3(0.0f))
            throw Error(fmt::format("{}: the normal of vertex {} is {} {} {}; it must be finite and not zero", name, i, mesh.normals[i].x,
                                    mesh.normals[i].y, mesh.normals[i].z));
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i)
        if (!std::isfinite(mesh.uvs[i].x) || !std::isfinite(mesh.uvs[i].y))
            throw Error(
                fmt::format("{}: the texture coordinate of vertex {} is {} {}; it must be finite", name, i, mesh.uvs[i].x, mesh.uvs[i].y));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t v : mesh.triangles[i])
            if (v >= mesh.positions.size())
                throw Error(fmt::format("{}: triangle {} uses vertex {}; there are {} (from 0)", name, i, v, mesh.positions.size()));
}

std::vector<glm::vec3> smooth_normals(const MeshData& mesh, const glm::dmat4& to_world) {
    const glm::dmat3 linear(to_world);
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const auto& triangle : mesh.triangles) {
        glm::dvec3 p[3];
        for (std::size_t k = 0; k < 3; ++k) p[k] = linear * glm::dvec3(mesh.positions[triangle[k]]);
        const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(cross);
        if (!(length > 0.0)) continue;
        const glm::dvec3 normal = cross / length;
        const double at0 = angle_between(p[1] - p[0], p[2] - p[0]), at1 = angle_between(p[2] - p[1], p[0] - p[1]);
        sums[triangle[0]] += normal * at0;
        sums[triangle[1]] += normal * at1;
        sums[triangle[2]] += normal * std::max(0.0, std::numbers::pi - at0 - at1);
    }
    // World normals are inverse-transpose(linear) * own normals, so own normals are transpose(linear) * world normals.
    const glm::dmat3 to_own = glm::transpose(linear);
    std::vector<glm::vec3> normals(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const bool any_area = glm::length(sums[i]) > 1e-12;  // angles are O(1): below this only cancellation is left
        normals[i] = glm::vec3(glm::normalize(to_own * (any_area ? sums[i] : glm::dvec3(1.0, 0.0, 0.0))));
    }
    return normals;
}

}  // namespace koksma::loader
