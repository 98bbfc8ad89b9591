// Affine maps of space, as joints and skinning use them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::rig {

using geometry::Mat3;
using geometry::Vec3;

/// x -> A.leftCols<3>() x + A.col(3). Without Eigen's alignment, which differs between programs for
/// processors with and without AVX.
using Affine = Eigen::Matrix<double, 3, 4, Eigen::DontAlign>;
/// The same for rotations that are stored.
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;

/// The map that leaves every point where it is.
inline Affine identity() {
  return Affine::Identity();
}

/// The map x -> linear x + shift.
inline Affine affine(const Mat3& linear, const Vec3& shift) {
  Affine map;
  map << linear, shift;
  return map;
}

/// The linear part of a map, without its shift.
inline Mat3 linear_of(const Affine& map) {
  return map.leftCols<3>();
}

/// The image of a point.
inline Vec3 apply(const Affine& map, const Vec3& point) {
  return map.leftCols<3>() * point + map.col(3);
}

/// The map that applies `first` and then `second`.
inline Affine compose(const Affine& second, const Affine& first) {
  Affine map;
  map.leftCols<3>().noalias() = second.leftCols<3>() * first.leftCols<3>();
  map.col(3).noalias() = second.leftCols<3>() * first.col(3) + second.col(3);
  return map;
}

/// The inverse map. Precondition: is_invertible(map).
inline Affine inverse(const Affine& map) {
  const Mat3 back = linear_of(map).inverse();
  return affine(back, -(back * map.col(3)));
}

/// Whether the map is finite and far enough from singular that its inverse keeps half of the digits.
bool is_invertible(const Affine& map);

}  // namespace bodice::rig
