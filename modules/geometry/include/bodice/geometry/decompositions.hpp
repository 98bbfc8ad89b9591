// Decompositions of 3x3 matrices, by Eigen. Each of its solvers takes seconds to compile, so that all layers
// share these.
#pragma once

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// Eigenvalues of a symmetric matrix, from the least to the greatest, and unit eigenvectors as columns in
/// that order.
struct SymmetricEigen {
  Vec3 values = Vec3::Zero();
  Mat3 vectors = Mat3::Identity();
};

/// Reads the lower triangle of the matrix alone.
SymmetricEigen eigen_of_symmetric(const Mat3& matrix);

/// The same by a closed formula: faster, and less exact where eigenvalues are close to each other.
SymmetricEigen direct_eigen_of_symmetric(const Mat3& matrix);

/// A matrix as u * diag(values) * v^T: u and v are orthogonal and may be reflections, values fall and are not
/// negative.
struct SingularValues {
  Mat3 u = Mat3::Identity();
  Vec3 values = Vec3::Zero();
  Mat3 v = Mat3::Identity();
  bool is_valid = false;  ///< false where the matrix is not finite or its squares overflow
};

SingularValues singular_values(const Mat3& matrix);

}  // namespace bodice::geometry
