// From a garment as people have it to one particle a place, with the way back to the input's vertices.
#pragma once

#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::cloth {

/// Vertices nearer than this fraction of the median edge are one particle. Wide enough for the rounding of
/// files along seams, narrow enough to keep a facing sewn on by hand a layer of its own.
inline constexpr double kSeamRelative = 0.01;

/// So are the ends of an edge shorter than this fraction of it: what its neighbors leave unsolved would be
/// all of its length.
inline constexpr double kShortRelative = 0.1;

struct WeldedGarment {
  geometry::TriMesh mesh;                           ///< #P particles, no degenerate or duplicate triangles
  std::vector<geometry::Index> particle_of_vertex;  ///< #V of the input: its particle, or kNoIndex if dropped
  double median_edge_m = 0.0;
  std::vector<engine::Warning> warnings;  ///< what was dropped
};

/// Welds along seams and short edges; drops vertices that are not finite or belong to no usable triangle, and
/// triangles without area. Particles keep the order of their first vertex. O(n log n). Fails with
/// kUnusableGeometry when no triangle is left.
engine::Result<WeldedGarment> weld(const geometry::TriMesh& garment, double seam_relative = kSeamRelative);

}  // namespace bodice::cloth
