// Welding: a garment's vertices become particles, with a map from vertices to particles.
#pragma once

#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::cloth {

/// Vertices closer than this fraction of the median edge become one particle. It covers the rounding of files
/// along seams, and keeps a facing that lies on another layer apart.
inline constexpr double kSeamRelative = 0.01;

/// The ends of an edge shorter than this fraction of the median edge become one particle, because the error
/// that longer neighbors leave would exceed its length.
inline constexpr double kShortRelative = 0.1;

/// A garment in particles.
struct WeldedGarment {
  geometry::TriMesh mesh;                           ///< #P particles, no degenerate or duplicate triangles
  std::vector<geometry::Index> particle_of_vertex;  ///< #V of the input: the particle, or kNoIndex if dropped
  double median_edge_m = 0.0;                       ///< of `mesh`
  std::vector<engine::Warning> warnings;            ///< warnings about dropped vertices and triangles
};

/// Welds along seams and short edges. Drops vertices that are not finite or belong to no usable triangle, and
/// triangles without area. Particles keep the order of their first vertex. O(n log n). Fails with
/// kUnusableGeometry if no triangle is left.
engine::Result<WeldedGarment> weld(const geometry::TriMesh& garment, double seam_relative = kSeamRelative);

}  // namespace bodice::cloth
