// Fins: small pieces of surface that stick out of a skin.
#pragma once

#include <vector>

#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::inline v0_1::geometry {

/// Marks (#F) the triangles of fins. Edges with three or more triangles cut the surface into pieces. A fin is
/// a piece that hangs on such an edge, has an open edge besides, and is a few triangles or has next to no
/// area. A wall inside the skin has no open edge, and a head or hand beyond a wall is larger; both stay, and
/// so does the largest piece. O(#F).
std::vector<bool> find_fins(const TriMesh& mesh, const MeshEdges& edges);

}  // namespace bodice::geometry
