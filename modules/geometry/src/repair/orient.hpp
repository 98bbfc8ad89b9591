#pragma once

#include <vector>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

struct Orientation {
  std::vector<bool> flip;     ///< #F: whether to reverse the triangle
  std::size_t flipped = 0;    ///< number of reversed triangles
  std::size_t conflicts = 0;  ///< edges that no choice makes consistent (Moebius bands)
};

/// Chooses the winding of each patch (triangles joined by edges of two) so that neighbors agree and the
/// signed volume is positive. A patch too flat to enclose anything keeps the winding of its majority. O(#F).
Orientation choose_orientation(const TriMesh& mesh, const MeshEdges& edges);

}  // namespace bodice::geometry
