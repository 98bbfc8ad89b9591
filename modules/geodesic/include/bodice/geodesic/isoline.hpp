// Isolines: curves of equal distance, the paper's eq. (2), chained into loops.
#pragma once

#include <span>

#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::inline v0_1::geodesic {

/// A curve along which a field on the skin has one value.
struct Isoline {
  std::vector<geometry::Vec3> points;  ///< on mesh edges, in order; a closed loop does not repeat its first
  std::vector<geometry::Index> edges;  ///< the edge of each point
  geometry::Vec3 centroid = geometry::Vec3::Zero();  ///< of the curve, weighted by length, meters
  double girth_m = 0.0;
  bool closed = false;  ///< false where the curve ends at a hole
};

/// The isolines of each level: result[i] belongs to levels[i], in the order of their lowest triangle.
/// Vertices at a level count as above it; triangles with an unreachable corner carry no isoline. O(#F +
/// length of the curves). Based on: the paper, eq. (2): v4 = v1 + (level - g1) / (g2 - g1) (v2 - v1), on
/// every edge that crosses.
std::vector<std::vector<Isoline>> isolines(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges,
                                           std::span<const float> field, std::span<const float> levels);

}  // namespace bodice::geodesic
