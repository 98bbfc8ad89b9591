#pragma once

#include <bodice/geometry/mesh_edges.hpp>

namespace bench {

/// Exact polyhedral distances from a vertex, #V, meters: the yardstick, hundreds of times slower than what it
/// measures. Precondition: a closed mesh or one whose boundary is convex along the skin.
std::vector<double> exact_distances(const bodice::geometry::TriMesh& mesh,
                                    const bodice::geometry::MeshEdges& edges, bodice::geometry::Index source);

}  // namespace bench
