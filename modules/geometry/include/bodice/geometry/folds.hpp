// Triangles that lie folded over their neighbors, as photogrammetry leaves them, and the surface without.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The share of the vertices at which a triangle points against the mean of the triangles there. Clean
/// surfaces have folds in lips and lids, one vertex in a hundred. Cost: O(#F), a millisecond.
double folded_share(const TriMesh& mesh);

/// The positions (#V) in which triangles hardly fold: each vertex goes along the surface toward the middle of
/// its neighbors, a few times, and then back onto the surface. Tips stay, and so do vertices of edges that
/// bound a hole or have more than two triangles. Paths along folded triangles lead to and fro, and are too
/// long. Cost: a microsecond a vertex. Precondition: every index of a triangle is below #V. Throws Canceled.
std::vector<Vec3> without_folds(const engine::Context& context, const TriMesh& mesh);

}  // namespace bodice::geometry
