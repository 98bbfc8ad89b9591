// Where an ellipsoid takes what is stuck to it from one pose to the next. Kept beside SurfaceMotion, which
// holds the way back in floats for the kernels: here every particle asks all ellipsoids.
#pragma once

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::collision {

struct Carrier {
  geometry::Mat3 turn = geometry::Mat3::Identity();
  geometry::Vec3 shift = geometry::Vec3::Zero();

  geometry::Vec3 now(const geometry::Vec3& before) const { return turn * before + shift; }
};

/// A material point keeps its place in the ellipsoid's frame, in shares of the radii.
inline Carrier carrier_between(const geometry::Ellipsoid& before, const geometry::Ellipsoid& now) {
  const geometry::Mat3 turn =
      now.axes * now.radii.cwiseQuotient(before.radii).asDiagonal() * before.axes.transpose();
  return {turn, now.center - turn * before.center};
}

}  // namespace bodice::collision
