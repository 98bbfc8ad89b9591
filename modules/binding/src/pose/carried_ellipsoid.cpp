#include "pose/carried_ellipsoid.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "pose/svd3.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::binding {
namespace {

using geometry::Mat3;
using geometry::Vec3;

double size_of(const Mat3& linear) {
  return std::cbrt(std::abs(linear.determinant()));
}

Vec3 not_flat(const Vec3& radii, const Vec3& rest, double scale) {
  return radii.cwiseMax(kFlattest * scale * rest.minCoeff());
}

}  // namespace

proxy::JointMatrix affine_map(std::span<const proxy::CarryTerm> terms,
                              std::span<const proxy::JointMatrix> skinning) {
  proxy::JointMatrix map = proxy::JointMatrix::Zero();
  for (const proxy::CarryTerm& term : terms) {
    const Eigen::Map<const Eigen::Matrix4d> m(term.matrix.data());
    const proxy::JointMatrix& t = skinning[term.joint];
    for (int column = 0; column < 4; ++column)
      map.col(column) += t.col(0) * m(0, column) + t.col(1) * m(1, column) + t.col(2) * m(2, column) +
                         t.col(3) * m(3, column);
  }
  return map;
}

proxy::JointMatrix unfolded(const proxy::JointMatrix& map, const Vec3& center, double body_scale) {
  const Mat3 linear = map.leftCols<3>();
  if (linear.determinant() > kFoldedVolume * body_scale * body_scale * body_scale) return map;
  const Svd3 svd = svd3(linear);
  Vec3 lengths = svd.values.cwiseMax(kLeastLength * body_scale);
  if (svd.right.determinant() < 0.0) lengths[2] *= -1.0;  // the map mirrors along the axis that it folds
  const Mat3 kept = svd.left * lengths.asDiagonal() * svd.right.transpose();
  proxy::JointMatrix result;
  result << kept, map.col(3) + (linear - kept) * center;
  return result;
}

CarriedEllipsoid carry(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map) {
  const Mat3 linear = map.leftCols<3>();
  const Svd3 svd = svd3(linear * rest.axes * rest.radii.asDiagonal());
  CarriedEllipsoid carried;
  // A map that folds nearly flat keeps the size of what it spans.
  carried.scale = std::max(size_of(linear), 0.1 * svd.values[0] / rest.radii.maxCoeff());
  carried.shape.center = linear * rest.center + map.col(3);
  carried.shape.axes = svd.left;
  carried.shape.radii = not_flat(svd.values, rest.radii, carried.scale);
  carried.to_table = svd.right;
  return carried;
}

CarriedEllipsoid carry_stiffly(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map) {
  const Mat3 axes = map.leftCols<3>() * rest.axes;
  const Svd3 svd = svd3(axes);
  CarriedEllipsoid carried;
  carried.scale = std::max(size_of(axes), 0.1 * svd.values[0]);
  carried.shape.center = map.leftCols<3>() * rest.center + map.col(3);
  carried.shape.axes = svd.left * svd.right.transpose();
  if (carried.shape.axes.determinant() < 0.0) carried.shape.axes.col(2) *= -1.0;
  const Vec3 stretch = (carried.shape.axes.transpose() * axes).diagonal().cwiseAbs();
  carried.shape.radii = not_flat(rest.radii.cwiseProduct(stretch), rest.radii, carried.scale);
  return carried;
}

}  // namespace bodice::binding
