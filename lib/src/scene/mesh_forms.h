#pragma once
// Meshes that are simpler than they look.

#include <koksma/math/vec3.h>

#include <array>
#include <cstdint>
#include <span>

namespace koksma::detail {

using TriangleIndices = std::array<std::uint32_t, 3>;

/// True where the vertices carry no other normals than the triangles have: interpolating them would be work for nothing.
/// Loaders make such normals for files without any, wherever no two faces share a vertex.
/// @param normals  by vertex as positions are; unit or zero
[[nodiscard]] bool are_flat(std::span<const Vec3f> positions, std::span<const Vec3f> normals, std::span<const TriangleIndices> triangles) noexcept;

/// True where two triangles make a parallelogram. Then their vertices are turned round, each triangle's in its own order, to be
/// (a, b, c) and (a, c, d): so the unit square maps onto both without a seam.
[[nodiscard]] bool make_parallelogram(std::span<const Vec3f> positions, std::span<TriangleIndices> triangles) noexcept;

}  // namespace koksma::detail
