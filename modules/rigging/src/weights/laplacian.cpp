// Based on: Ulrich Pinkall, Konrad Polthier. Computing discrete minimal surfaces and their conjugates. 1993.
#include "weights/laplacian.hpp"

#include <algorithm>

namespace bodice::inline v0_1::rigging {
namespace {

/// Bounds of an edge's weight: a needle of a triangle neither blocks heat nor shorts it.
constexpr double kLeastCotangent = 0.02, kMostCotangent = 20.0;

double cotangent(const geometry::Vec3& at, const geometry::Vec3& a, const geometry::Vec3& b) {
  const geometry::Vec3 u = a - at, v = b - at;
  const double sine = u.cross(v).norm();
  return sine > 0.0 ? u.dot(v) / sine : kMostCotangent;
}

}  // namespace

Laplacian laplacian(const geometry::TriMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  Laplacian result;
  result.area.assign(n, 0.0);
  std::vector<double> diagonal(n, 0.0);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * n + 3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const double area = 0.5 * geometry::area_vector(mesh, f).norm();
    for (int k = 0; k < 3; ++k) {
      const geometry::Index i = mesh.triangles[f][(k + 1) % 3], j = mesh.triangles[f][(k + 2) % 3];
      result.area[mesh.triangles[f][k]] += area / 3.0;
      if (i == j) continue;
      const double w = 0.5 * std::clamp(cotangent(mesh.corner(f, k), mesh.positions[i], mesh.positions[j]),
                                        kLeastCotangent, kMostCotangent);
      entries.emplace_back(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)), -w);
      diagonal[i] += w;
      diagonal[j] += w;
    }
  }
  for (std::size_t v = 0; v < n; ++v)
    entries.emplace_back(static_cast<int>(v), static_cast<int>(v), diagonal[v]);
  result.stiffness.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  result.stiffness.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace bodice::rigging
