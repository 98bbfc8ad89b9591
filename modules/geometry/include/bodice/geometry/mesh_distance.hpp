// The exact signed distance to a triangle mesh, by which every accuracy that bodice reports is measured.
#pragma once

#include <memory>
#include <optional>

#include <bodice/engine/context.hpp>
#include <bodice/engine/function_ref.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The closest point of a mesh to some point, with the distance between them.
struct SurfacePoint {
  double signed_distance = 0.0;  ///< meters, negative inside
  Vec3 point = Vec3::Zero();     ///< closest point of the mesh
  Vec3 normal = Vec3::Zero();    ///< outward unit normal of the nearest triangle
  Index triangle = kNoIndex;     ///< the triangle that holds the point
};

/// A bounding-volume tree over a mesh, of which it keeps a copy. It is immutable and thread-safe once built.
/// A point is inside where the generalized winding number is above one half, so that small holes, overlaps at
/// folds and several components still have an inside.
class MeshDistance {
 public:
  /// Builds the tree in O(n log n). For an empty mesh every distance is +infinity. Triangles with a vertex
  /// that is not there or not finite are left out. Throws engine::Canceled if the context is canceled.
  MeshDistance(const engine::Context& context, const TriMesh& mesh);
  /// Fits the tree of `like` to the same triangles with other positions, such as a skin in another pose;
  /// O(n). Distances are those of a tree that is built for them. Queries take longer where triangles that
  /// were near each other are far apart.
  MeshDistance(const engine::Context& context, const MeshDistance& like, const TriMesh& mesh);
  ~MeshDistance();
  MeshDistance(MeshDistance&&) noexcept;
  MeshDistance& operator=(MeshDistance&&) noexcept;

  /// The closest point with the signed distance. Cost: O(log n) typically.
  SurfacePoint closest_point(const Vec3& query) const;
  /// The closest point if it is within `max_distance_m`, else nothing. Its distance carries NO sign: it is
  /// never negative. Cost: half that of closest_point().
  std::optional<SurfacePoint> closest_point_within(const Vec3& query, double max_distance_m) const;
  /// The same among the triangles for which counts(triangle) holds. It is called for those that may be the
  /// nearest so far, and at least for one that is returned.
  std::optional<SurfacePoint> closest_point_within(const Vec3& query, double max_distance_m,
                                                   engine::FunctionRef<bool(Index)> counts) const;
  /// The signed distance alone, at the same cost.
  double signed_distance(const Vec3& query) const { return closest_point(query).signed_distance; }
  /// The generalized winding number: 1 inside a closed mesh that is wound outward, 0 outside.
  double winding_number(const Vec3& query) const;
  /// Whether the winding number is above this, to 0.01: one half is between outside and inside, one and a
  /// half between a body and two layers of it. Cost: a seventh of winding_number(), except next to a hole.
  bool winds_more_than(double number, const Vec3& query) const;
  /// Whether the winding number is above one half.
  bool inside(const Vec3& query) const { return winds_more_than(0.5, query); }
  /// Whether the mesh has no border, so that winding numbers are whole: each edge has as many triangles in
  /// one direction as in the other. A mesh without triangles is closed.
  bool is_closed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bodice::geometry
