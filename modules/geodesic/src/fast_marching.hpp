#pragma once

#include <bodice/geodesic/distance.hpp>

namespace bodice::inline v0_1::geodesic {

/// Distances by a front that crosses triangles. O(#F log #V).
Field fast_marching(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges,
                    const geometry::EdgesOfVertex& around, std::span<const Seed> seeds);

}  // namespace bodice::geodesic
