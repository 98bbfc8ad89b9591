#pragma once

#include <bodice/geometry/mesh_edges.hpp>

namespace bench {

/// Exact polyhedral distances from a vertex, #V, meters: the reference, hundreds of times slower than what it
/// measures. Precondition: the mesh is closed, or its boundary is convex along the skin.
std::vector<double> exact_distances(const bodice::geometry::TriMesh& mesh,
                                    const bodice::geometry::MeshEdges& edges, bodice::geometry::Index source);

}  // namespace bench
