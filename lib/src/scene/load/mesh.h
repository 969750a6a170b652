#pragma once
// Meshes: what every reader checks, and normals for those that come without.

#include <koksma/scene/description.h>

#include <glm/mat4x4.hpp>

#include <filesystem>

namespace koksma::loader {

inline constexpr float kMaxCoordinate = 1e18f;  ///< Embree refuses rays beyond 1.8e18; a vertex out there could only make such rays

/// @throws Error naming file and vertex: no triangle, NaN, infinite or huge vertex, zero or non-finite normal, index out of range
void check_mesh(const MeshData& mesh, const std::filesystem::path& file);

/// Vertex normals in the mesh's own space that are, in world space, the mean of the adjacent triangles' normals weighted by their
/// angles at the vertex, which is what Mitsuba gives to a mesh without normals. A vertex with no area around it gets (1, 0, 0).
/// Source: Thürmer & Wüthrich 1998, "Computing Vertex Normals from Polygonal Facets", JGT 3(1)
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const MeshData& mesh, const glm::dmat4& to_world);

}  // namespace koksma::loader
