#include "frame/moved_ellipsoid.hpp"

#include <cmath>

#include <Eigen/LU>

namespace bodice::inline v0_1::capi {
namespace {

/// Largest entry of R^T R - 1 that is taken for rounding: what 50 bones of float in a chain stay far below,
/// and no visible shear.
constexpr double kDrift = 1e-3;
/// Scales beyond these are garbage.
constexpr double kLeastScale = 1e-6, kMostScale = 1e6;

/// The rotation nearest to a matrix that is nearly one: Newton's iteration, with an error that squares in
/// each step. Source: Nicholas J. Higham. Computing the Polar Decomposition, with Applications. 1986.
geometry::Mat3 nearest_rotation(geometry::Mat3 matrix) {
  for (int step = 0; step < 3; ++step) matrix = 0.5 * (matrix + matrix.inverse().transpose()).eval();
  return matrix;
}

}  // namespace

std::string_view move_ellipsoid(const geometry::Ellipsoid& rest, const proxy::JointMatrix& map,
                                geometry::Ellipsoid& out) {
  if (!map.allFinite()) return "is not finite";
  const geometry::Mat3 linear = map.leftCols<3>();
  const double volume = linear.determinant();
  if (volume < 0.0) return "mirrors";
  const double scale = std::cbrt(volume);
  if (!(scale >= kLeastScale && scale <= kMostScale)) return "has no extent, or more than a million";
  const geometry::Mat3 unit = linear / scale;
  if (!((unit.transpose() * unit - geometry::Mat3::Identity()).cwiseAbs().maxCoeff() <= kDrift))
    return "shears, or scales its axes unlike";
  out.center = linear * rest.center + map.col(3);
  out.axes = nearest_rotation(unit) * rest.axes;
  out.radii = scale * rest.radii;
  return {};
}

}  // namespace bodice::capi
