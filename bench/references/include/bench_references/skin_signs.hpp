// The side of a closed skin that a point is on, by the normal where the skin is closest.
#pragma once

#include <vector>

#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/triangle.hpp>

namespace bench {

/// Normals of a skin's faces, edges and vertices, such that their sign is that of the distance on a closed
/// skin that does not cut itself.
/// Based on: J. Andreas Baerentzen, Henrik Aanaes. Signed distance computation using the angle weighted
/// pseudonormal. 2005.
class SkinSigns {
 public:
  explicit SkinSigns(const bodice::geometry::TriMesh& mesh) : edges_(bodice::geometry::mesh_edges(mesh)) {}

  /// Computes the normals for the current vertices; the triangles are those of the constructor.
  void update(const bodice::geometry::TriMesh& mesh);

  /// Whether `point` lies inside; `closest`, in triangle t, is the skin's closest point to it.
  bool is_inside(const bodice::geometry::TriMesh& mesh, bodice::geometry::Index t,
                 const bodice::geometry::TrianglePoint& closest, const bodice::geometry::Vec3& point) const;

  double bytes() const;

 private:
  bodice::geometry::MeshEdges edges_;
  std::vector<bodice::geometry::Vec3> face_, vertex_;
};

}  // namespace bench
