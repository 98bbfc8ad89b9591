// A well-conditioned frame for a point set: the first step of every ellipsoid fit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::fitting {

using geometry::Mat3;
using geometry::Vec3;

/// Points mapped into the box [-1, 1]^rank: p = origin + axes * (extent o y). Columns of y beyond the rank
/// are unused.
struct PointFrame {
  Vec3 origin = Vec3::Zero();
  Mat3 axes = Mat3::Identity();          ///< orthonormal, from the longest direction to the thinnest
  Vec3 extent = Vec3::Zero();            ///< half-extent along each axis, meters
  int rank = 0;                          ///< number of axes along which the set is not flat
  double thickness = 0.0;                ///< largest half-extent over the flat axes
  std::array<std::vector<double>, 3> y;  ///< structure of arrays, #kept each
  std::vector<Vec3> kept;                ///< the finite points
};

/// The frame of a greedy basis: the direction of the point farthest from the origin, then of the point
/// farthest from that line. Each direction is accurate to rounding of its own length; a covariance would
/// square the aspect ratio. O(#points).
PointFrame make_point_frame(std::span<const Vec3> points, double flat_relative);

}  // namespace bodice::fitting
