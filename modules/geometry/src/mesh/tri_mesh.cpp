#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

double surface_area(const TriMesh& mesh) {
  double twice_area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) twice_area += area_vector(mesh, t).norm();
  return 0.5 * twice_area;
}

double signed_volume(const TriMesh& mesh) {
  if (mesh.empty()) return 0.0;
  // The tetrahedra start at a vertex of the mesh, so that 10 km from the origin cost no digits.
  const Vec3 apex = mesh.corner(0, 0);
  double six_volumes = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - apex;
    const Vec3 b = mesh.corner(t, 1) - apex;
    const Vec3 c = mesh.corner(t, 2) - apex;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    for (Index v : mesh.triangles[t]) normals[v] += area;
  }
  // stableNormalize scales first: squares of square micrometers would underflow.
  for (Vec3& n : normals) n.stableNormalize();
  return normals;
}

}  // namespace bodice::geometry
