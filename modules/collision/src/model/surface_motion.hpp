// How the material of each ellipsoid moved from the pose before to the pose now.
#pragma once

#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::collision {

/// Velocity of the material at x carried by one ellipsoid: linear x + translation, meters a second.
struct SurfaceMotion {
  float linear[9] = {};
  float translation[3] = {};

  geometry::Vec3 at(const geometry::Vec3& x) const;
};

/// A material point keeps its place in the ellipsoid's frame, in shares of the radii.
SurfaceMotion motion_between(const geometry::Ellipsoid& before, const geometry::Ellipsoid& now, double dt_s);

/// No material of the ellipsoid moved farther than this between the poses, meters.
double travel_between(const geometry::Ellipsoid& before, const geometry::Ellipsoid& now);

}  // namespace bodice::collision
