// The cotangent Laplacian of a triangle mesh.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::rigging {

struct Laplacian {
  /// #V x #V, positive semidefinite: half the sum of the cotangents opposite each edge, which is kept from
  /// falling below a small positive weight, so that heat never runs uphill. Its lower triangle.
  Eigen::SparseMatrix<double> stiffness;
  std::vector<double> area;  ///< #V: a third of the triangles around each vertex, square meters
};

/// O(#V + #F).
Laplacian laplacian(const geometry::TriMesh& mesh);

}  // namespace bodice::rigging
