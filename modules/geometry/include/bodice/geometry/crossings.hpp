// Triangles of a surface that cross each other.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The pairs of triangles of which one has an edge that passes through the other, sorted, the smaller number
/// first. Edges that end at a corner of the other triangle, by index or by equal positions, do not count, nor
/// does what only touches. Triangles with a position that is not finite cross nothing. Cost: that of all
/// pairs with boxes that overlap along the axis on which the surface is longest.
std::vector<std::array<std::size_t, 2>> find_crossings(std::span<const Vec3> positions,
                                                       std::span<const Triangle> triangles);

}  // namespace bodice::geometry
