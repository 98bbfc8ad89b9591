#pragma once

#include <Eigen/Geometry>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// An indexed triangle mesh. Inside bodice its unit is the meter, y is up, and triangles are
/// counter-clockwise seen from outside.
struct TriMesh {
  std::vector<Vec3> positions;      ///< #V
  std::vector<Triangle> triangles;  ///< #F, indices into positions

  bool empty() const { return triangles.empty(); }
  const Vec3& corner(std::size_t triangle, int k) const {
    return positions[triangles[triangle][static_cast<std::size_t>(k)]];
  }
};

/// The triangle's unit normal times twice its area.
inline Vec3 area_vector(const TriMesh& mesh, std::size_t triangle) {
  const Vec3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a);
}

/// The surface area, in square meters. O(#F).
double surface_area(const TriMesh& mesh);

/// The signed volume by the divergence theorem, in cubic meters; it is positive for a mesh wound outward.
/// O(#F).
double signed_volume(const TriMesh& mesh);

/// Area-weighted unit normals, #V; zero at vertices that no triangle gives a direction. O(#V + #F).
std::vector<Vec3> vertex_normals(const TriMesh& mesh);

}  // namespace bodice::geometry
