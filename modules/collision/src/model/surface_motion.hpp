// The motion of each ellipsoid's material from the last pose to this one.
#pragma once

#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::collision {

/// The material of an ellipsoid in a pose: its points are center + axes u, |u| <= 1, and each keeps its u.
struct Material {
  geometry::Vec3 center = geometry::Vec3::Zero();
  geometry::Mat3 axes = geometry::Mat3::Identity();  ///< meters, not orthonormal
};

/// The material that keeps its coordinates in the ellipsoid's frame, in units of the radii.
inline Material material_of(const geometry::Ellipsoid& shape) {
  return {shape.center, shape.axes * shape.radii.asDiagonal()};
}

/// Material with the inverse of its axes, which the motion to this pose and that from it both need.
struct InvertedMaterial : Material {
  geometry::Mat3 inverse_axes = geometry::Mat3::Identity();

  void set(const geometry::Vec3& new_center, const geometry::Mat3& new_axes);
};

/// Velocity of the material at x that moves with one ellipsoid: linear x + translation, meters a second.
struct SurfaceMotion {
  float linear[9] = {};
  float translation[3] = {};

  /// The motion of material from one pose to the next. Zero if dt_s is not positive.
  void set(const InvertedMaterial& before, const InvertedMaterial& now, double dt_s);
  geometry::Vec3 at(const geometry::Vec3& x) const;
};

/// Upper bound on the displacement of any material point between the poses, meters.
double travel_between(const Material& before, const Material& now);

}  // namespace bodice::collision
