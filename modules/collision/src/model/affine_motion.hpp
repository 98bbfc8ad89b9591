// Affine motion of an ellipsoid from the last pose to this one, in double precision. SurfaceMotion holds the
// inverse in floats for the kernels; the exact side needs this direction, for all ellipsoids.
#pragma once

#include "model/surface_motion.hpp"

namespace bodice::inline v0_1::collision {

/// Maps a material point from the last pose to this one: linear x + translation.
struct AffineMotion {
  geometry::Mat3 linear = geometry::Mat3::Identity();
  geometry::Vec3 translation = geometry::Vec3::Zero();

  /// The motion of material from one pose to the next.
  void set(const InvertedMaterial& before, const InvertedMaterial& now) {
    linear.noalias() = now.axes * before.inverse_axes;
    translation = now.center - linear * before.center;
  }
  geometry::Vec3 apply(const geometry::Vec3& before) const { return linear * before + translation; }
};

}  // namespace bodice::collision
