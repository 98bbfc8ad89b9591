// How much of one surface lies near another one.
#pragma once

#include <bodice/geometry/mesh_distance.hpp>

namespace bodice_test {

/// The share of a mesh's area, by the middles of its triangles, that lies within a distance of another mesh.
inline double share_near(const bodice::geometry::TriMesh& mesh, const bodice::geometry::TriMesh& other,
                         double within_m) {
  const bodice::geometry::MeshDistance distance({}, other);
  double all = 0.0, near = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const double area = area_vector(mesh, t).norm();
    all += area;
    if (distance.closest_point_within((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3.0,
                                      within_m))
      near += area;
  }
  return near / all;
}

}  // namespace bodice_test
