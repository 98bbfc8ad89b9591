// The sum of the solid angles of many triangles, at the price of one arc tangent.
// Based on: Adriaan van Oosterom, Jan Strackee. The Solid Angle of a Plane Triangle. 1983. - eq. (8)
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// Half of a solid angle, in (-pi, pi), as its sine and cosine times a common positive factor.
struct HalfAngle {
  double sine = 0.0, cosine = 1.0;
};

inline HalfAngle half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex) {
  const Vec3 u = a - apex;
  const Vec3 v = b - apex;
  const Vec3 w = c - apex;
  const double lu = u.norm();
  const double lv = v.norm();
  const double lw = w.norm();
  return {u.dot(v.cross(w)), lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv};
}

/// A sum of angles. They are added as complex numbers are multiplied, and whole turns are counted. No sign
/// that decides a turn is that of a difference that cancels.
class SolidAngleSum {
 public:
  void add(const HalfAngle& h) {
    if (h.sine == 0.0) return;  // the apex lies on the triangle's plane or an edge: the angle is 0
    const bool was_up = sine_ >= 0.0, goes_up = h.sine > 0.0;
    const double least = std::min(cosine_, h.cosine), most = std::max(cosine_, h.cosine);
    const bool within_quarters = least >= 0.0 && most > 0.0, beyond_quarters = most < 0.0;
    const double sine = sine_ * h.cosine + cosine_ * h.sine;
    cosine_ = cosine_ * h.cosine - sine_ * h.sine;
    sine_ = sine;
    if (was_up == goes_up && !within_quarters && (beyond_quarters || (sine >= 0.0) != was_up))
      turns_ += was_up ? 1 : -1;
    const double size = std::abs(cosine_) + std::abs(sine_);
    if (!(size > kLeast && size < kMost)) rescale(size);
  }

  /// The sum of the solid angles (not of their halves), in radians.
  double total() const {  // + 0.0 makes a sine of -0 count as up
    return 2.0 * (std::atan2(sine_ + 0.0, cosine_) + 2.0 * std::numbers::pi * turns_);
  }

 private:
  static constexpr double kLeast = 1e-100, kMost = 1e100;

  void rescale(double size) {
    if (size > 0.0 && std::isfinite(size)) sine_ /= size, cosine_ /= size;
  }

  double sine_ = 0.0, cosine_ = 1.0;
  int turns_ = 0;
};

}  // namespace bodice::geometry
