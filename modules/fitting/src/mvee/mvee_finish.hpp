// Makes an ellipsoid in meters of dual weights, with its certificate measured again on the points themselves.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <bodice/fitting/mvee.hpp>

#include "mvee/point_frame.hpp"

namespace bodice::inline v0_1::fitting {

/// The ellipsoid { center + half * unit ball }; vanishing columns give vanishing radii.
geometry::Ellipsoid spanned(const Vec3& center, const Mat3& half);

/// Sets result.ellipsoid to { center + half * unit ball }, raises radii to their least value, grows it to
/// hold every point, and records rank, gap and violation. `dual_log_volume`, a sum of log radii, bounds the
/// least volume from below.
void certify(const PointFrame& frame, const Vec3& center, const Mat3& half, double dual_log_volume,
             double min_radius_m, Mvee& result);

/// The solution of ranks 0 and 1, in closed form.
Mvee finish_thin(const PointFrame& frame, double min_radius_m);

/// Makes the ellipsoid of a dual solution: `points` is R x m in the frame, `weights` m on the simplex.
template <int R, class Points, class Weights>
void finish(const PointFrame& frame, const Points& points, const Weights& weights, double min_radius_m,
            Mvee& result) {
  using Vector = Eigen::Matrix<double, R, 1>;
  using Square = Eigen::Matrix<double, R, R>;
  const Vector c = points * weights;
  const auto centered = (points.colwise() - c).eval();
  const Square spread = R * (centered * weights.asDiagonal() * centered.transpose());
  const Square root = spread.llt().matrixL();
  Vec3 center = frame.origin;
  Mat3 half = Mat3::Zero();
  double log_volume = 0.0;
  for (int j = 0; j < R; ++j) {
    center += frame.extent[j] * c[j] * frame.axes.col(j);
    log_volume += std::log(root(j, j) * frame.extent[j]);
  }
  for (int k = 0; k < R; ++k)
    for (int j = k; j < R; ++j) half.col(k) += frame.extent[j] * root(j, k) * frame.axes.col(j);
  certify(frame, center, half, log_volume, min_radius_m, result);
}

}  // namespace bodice::fitting
