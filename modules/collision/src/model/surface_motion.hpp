// The motion of each ellipsoid's material from the last pose to this one.
#pragma once

#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::collision {

/// Velocity of the material at x that moves with one ellipsoid: linear x + translation, meters a second.
struct SurfaceMotion {
  float linear[9] = {};
  float translation[3] = {};

  geometry::Vec3 at(const geometry::Vec3& x) const;
};

/// The motion for which a material point keeps its coordinates in the ellipsoid's frame, in units of the
/// radii.
SurfaceMotion motion_between(const geometry::Ellipsoid& before, const geometry::Ellipsoid& now, double dt_s);

/// Upper bound on the displacement of the ellipsoid's material between the poses, meters.
double travel_between(const geometry::Ellipsoid& before, const geometry::Ellipsoid& now);

}  // namespace bodice::collision
