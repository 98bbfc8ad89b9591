// How a ramp or a seam meets a clip without a jolt: by the clip's own motion, mirrored in time.
#pragma once

#include <algorithm>
#include <cmath>

#include <bodice/rig/affine.hpp>

namespace bodice::inline v0_1::rig {

/// Seconds of the clip that are mirrored, so many seconds away from it. They fade, because all of a fast
/// clip, mirrored, would bend joints too far.
inline double lead_s(double away_s) {
  constexpr double kLongest_s = 0.1;
  return kLongest_s * std::tanh(away_s / kLongest_s);
}

/// What lies as far beyond `now` as `other` lies on its other side.
inline Vec3 mirrored(const Vec3& now, const Vec3& other) {
  return 2.0 * now - other;
}
inline Eigen::Quaterniond mirrored(const Eigen::Quaterniond& now, const Eigen::Quaterniond& other) {
  return now * other.conjugate() * now;
}

/// A weight that rises from 0 to 1 without a jerk at either end.
inline double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace bodice::rig
