// One closed surface out of patches, pieces and holes.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// A closed surface, and which of its vertices lie on the surface that it was made from.
struct RebuiltSurface {
  TriMesh mesh;  ///< closed, wound outward; parts that are flat or below a hundredth of it are left out
  std::vector<bool> measured;   ///< #V; others close holes and gaps
  double measured_share = 0.0;  ///< of the area
  double lost_share = 0.0;      ///< share of the given area that the surface lacks, such as tips of fingers
};

/// The boundary of the region where the winding number of `surface` is above one half, with cells of
/// `cell_m`, in the unit of the mesh. Where the surface is within a cell, vertices are moved onto it. Parts
/// that are thinner than a cell, such as fingers, are kept where they lie within twelve cells of the others.
/// Gaps and holes are closed as far as the surface around them goes; what is inside twice is inside.
/// Precondition: triangles wound outward, at least in the main. Empty if nothing is inside. Deterministic.
RebuiltSurface rebuild(const engine::Context& context, const TriMesh& surface, double cell_m);

}  // namespace bodice::geometry
