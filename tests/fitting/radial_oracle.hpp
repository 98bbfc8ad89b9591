// The distance of eq. (6) without the fit's formula.
#pragma once

#include <cmath>

#include <bodice/geometry/ellipsoid.hpp>

namespace fitting_test {

inline bool holds(const bodice::geometry::Ellipsoid& e, const bodice::geometry::Vec3& p) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = e.axes.col(axis).dot(p - e.center) / e.radii[axis];
    sum += along * along;
  }
  return sum <= 1.0;
}

/// Distance from a point to where the ray from the center through it leaves the ellipsoid, to rounding: the
/// exit is bisected. The point is not the center.
inline double radial_distance_by_bisection(const bodice::geometry::Ellipsoid& e,
                                           const bodice::geometry::Vec3& p) {
  const double length = (p - e.center).norm();
  const bodice::geometry::Vec3 direction = (p - e.center) / length;
  double inside = 0.0, outside = 2.0 * e.radii.maxCoeff();
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (inside + outside);
    (holds(e, e.center + middle * direction) ? inside : outside) = middle;
  }
  return std::abs(length - inside);
}

}  // namespace fitting_test
