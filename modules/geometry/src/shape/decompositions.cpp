#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <bodice/geometry/decompositions.hpp>

namespace bodice::inline v0_1::geometry {

SymmetricEigen eigen_of_symmetric(const Mat3& matrix) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen direct_eigen_of_symmetric(const Mat3& matrix) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SingularValues singular_values(const Mat3& matrix) {
  const Eigen::JacobiSVD<Mat3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return {};
  return {svd.matrixU(), svd.singularValues(), svd.matrixV(), true};
}

}  // namespace bodice::geometry
