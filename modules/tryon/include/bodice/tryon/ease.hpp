// The ease of a garment on each part of a body: its gap to the skin and its strain.
#pragma once

#include <span>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// A garment over one part of the body. Quantiles are by area of the cloth.
struct PartEase {
  body::Part part = body::Part::kHead;         ///< the part that the cloth is nearest to
  double area_m2 = 0.0;                        ///< area of the cloth there, as it lies
  double gap_median_m = 0.0, gap_p95_m = 0.0;  ///< signed distance from the cloth to the skin
  /// Elongation of the most stretched edge of a triangle, zero or more.
  double strain_mean = 0.0, strain_p95 = 0.0;
  double girth_m = 0.0;  ///< mean girth of the part: its area over its length
};

/// Measures a garment at the centroids of its triangles. `rest` is the garment as it was made, and `now` its
/// positions (#V, meters). `part` is the part of each vertex of `skin`, and `distance` the exact distance to
/// `skin`, both in the pose of `now`. Parts without cloth are left out; triangles with a position that is not
/// finite are skipped. The result does not depend on the number of workers. Cost: a closest point a triangle,
/// a few microseconds.
std::vector<PartEase> measure_ease(const engine::Context& context, const geometry::TriMesh& skin,
                                   std::span<const body::Part> part, const geometry::MeshDistance& distance,
                                   const geometry::TriMesh& rest, std::span<const geometry::Vec3> now);

}  // namespace bodice::tryon
