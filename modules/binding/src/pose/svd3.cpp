// Based on: C. G. J. Jacobi. Über ein leichtes Verfahren, die in der Theorie der Säcularstörungen
// vorkommenden Gleichungen numerisch aufzulösen. 1846 (rotations that diagonalize a symmetric matrix).
#include "pose/svd3.hpp"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::binding {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSweeps = 12;
constexpr double kDiagonal = 1e-30;  // square of an off-diagonal entry over the product of its diagonals

/// Turns axes p and q so that s(p, q) vanishes.
void turn(Matrix3d& s, Matrix3d& v, int p, int q) {
  const double off = s(p, q);
  if (off == 0.0) return;
  const double theta = (s(q, q) - s(p, p)) / (2.0 * off);
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), d = t * c;
  const int r = 3 - p - q;
  const double rp = s(r, p), rq = s(r, q);
  s(p, p) -= t * off;
  s(q, q) += t * off;
  s(p, q) = s(q, p) = 0.0;
  s(r, p) = s(p, r) = c * rp - d * rq;
  s(r, q) = s(q, r) = d * rp + c * rq;
  const Vector3d vp = v.col(p);
  v.col(p) = c * vp - d * v.col(q);
  v.col(q) = d * vp + c * v.col(q);
}

bool is_diagonal(const Matrix3d& s) {
  return s(0, 1) * s(0, 1) <= kDiagonal * s(0, 0) * s(1, 1) &&
         s(0, 2) * s(0, 2) <= kDiagonal * s(0, 0) * s(2, 2) &&
         s(1, 2) * s(1, 2) <= kDiagonal * s(1, 1) * s(2, 2);
}

void swap_columns(Svd3& svd, int i, int j) {
  if (svd.values[i] >= svd.values[j]) return;
  std::swap(svd.values[i], svd.values[j]);
  const Vector3d column = svd.right.col(i);
  svd.right.col(i) = svd.right.col(j);
  svd.right.col(j) = column;
}

}  // namespace

Svd3 svd3(const Matrix3d& m) {
  Svd3 svd;
  const double size = m.cwiseAbs().maxCoeff();
  svd.left = svd.right = Matrix3d::Identity();
  svd.values.setZero();
  if (!(size > 0.0)) return svd;
  const Matrix3d unit = m / size;
  Matrix3d s = unit.transpose() * unit;
  for (int sweep = 0; sweep < kSweeps && !is_diagonal(s); ++sweep) {
    turn(s, svd.right, 0, 1);
    turn(s, svd.right, 0, 2);
    turn(s, svd.right, 1, 2);
  }
  for (int i = 0; i < 3; ++i) svd.values[i] = (unit * svd.right.col(i)).norm();
  swap_columns(svd, 0, 1);
  swap_columns(svd, 0, 2);
  swap_columns(svd, 1, 2);
  const Matrix3d image = unit * svd.right;
  svd.left.col(0) = image.col(0) / svd.values[0];
  // Where the image is a line, any direction across it serves.
  Vector3d second = image.col(1) - svd.left.col(0) * svd.left.col(0).dot(image.col(1));
  if (second.norm() <= 1e-12 * svd.values[0]) second = svd.left.col(0).unitOrthogonal();
  svd.left.col(1) = second.normalized();
  svd.left.col(2) = svd.left.col(0).cross(svd.left.col(1));
  if (svd.left.col(2).dot(image.col(2)) < 0.0) svd.right.col(2) = -svd.right.col(2);
  svd.values *= size;
  return svd;
}

}  // namespace bodice::binding
