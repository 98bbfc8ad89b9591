// Exact signed distance to a triangle mesh: the judge of every accuracy that bodice reports.
#pragma once

#include <memory>
#include <optional>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::geometry {

struct SurfacePoint {
  double signed_distance = 0.0;  ///< meters, negative inside
  Vec3 point = Vec3::Zero();     ///< closest point of the mesh
  Vec3 normal = Vec3::Zero();    ///< outward unit normal of the nearest triangle
  Index triangle = kNoIndex;     ///< the triangle that holds it
};

/// A bounding-volume tree over a mesh. Immutable and thread-safe once built; keeps its own copy of the mesh.
/// The sign is the generalized winding number's (above one half is inside), so that small holes, overlaps at
/// folds and several components still have an inside.
class MeshDistance {
 public:
  /// O(n log n). An empty mesh gives a tree whose every distance is +infinity.
  MeshDistance(const engine::Context& context, const TriMesh& mesh);
  ~MeshDistance();
  MeshDistance(MeshDistance&&) noexcept;
  MeshDistance& operator=(MeshDistance&&) noexcept;

  /// Closest point and sign; O(log n) typical.
  SurfacePoint closest_point(const Vec3& query) const;
  /// The closest point if it is within `max_distance_m`, else nothing. Its distance carries NO sign: it is
  /// never negative. Half the cost of closest_point().
  std::optional<SurfacePoint> closest_point_within(const Vec3& query, double max_distance_m) const;
  double signed_distance(const Vec3& query) const { return closest_point(query).signed_distance; }
  /// The generalized winding number: 1 inside a closed outward mesh, 0 outside.
  double winding_number(const Vec3& query) const;
  /// Whether that is above one half; a fifth of its cost where it is clear, as it is but next to a hole.
  bool inside(const Vec3& query) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::geometry
