// Closed meshes that touch themselves along edges, made edge-manifold.
#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// Where four or more triangles meet at an edge of a closed, wound mesh, gives each sheet of surface a vertex
/// of its own, so that every edge has two triangles. The copies, the original among them, move from it toward
/// their own neighbors by `share` of the mean edge, so that programs that merge equal positions keep them
/// apart. Returns the original of each vertex that was added, in order. A mesh without such edges keeps its
/// bits. O(#F log #F).
std::vector<Index> split_pinches(TriMesh& mesh, double share);

}  // namespace bodice::geometry
