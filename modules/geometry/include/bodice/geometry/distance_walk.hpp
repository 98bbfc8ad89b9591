// Signed distances of many points, of which each lies near the one before: samples of a piece of cloth.
#pragma once

#include <optional>

#include <bodice/geometry/mesh_distance.hpp>

namespace bodice::inline v0_1::geometry {

/// Gives the distances that MeshDistance::closest_point() does. The ball around a point up to its closest
/// surface holds no surface. So two points have the same sign where their balls overlap, and the distance to
/// the last point limits the search for the next. Between triangles that are equally near, another one may be
/// chosen. Cost: a search within the bound, and a winding number where balls do not overlap or the mesh is
/// not closed. The mesh must outlive the walk. One walk serves one thread.
class DistanceWalk {
 public:
  explicit DistanceWalk(const MeshDistance& mesh) : mesh_(&mesh) {}

  /// The closest point with the signed distance.
  SurfacePoint closest_point(const Vec3& query);

  /// A lower bound on the signed distance at a point, by that of the last one: no distance falls by more than
  /// the point moves. Minus infinity before the first point, and for meshes that are not closed, where a sign
  /// may change without a surface.
  double least_distance_m(const Vec3& query) const;

 private:
  const MeshDistance* mesh_;
  std::optional<Vec3> last_;
  double last_m_ = 0.0;  ///< the signed distance there
};

}  // namespace bodice::geometry
