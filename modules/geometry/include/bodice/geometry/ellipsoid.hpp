#pragma once

#include <array>

#include <bodice/geometry/types.hpp>

namespace bodice::geometry {

/// { c + R diag(r) u : |u| <= 1 }.
struct Ellipsoid {
  Vec3 center = Vec3::Zero();    ///< c, meters
  Mat3 axes = Mat3::Identity();  ///< R, columns are the unit semi-axis directions, right-handed
  Vec3 radii = Vec3::Ones();     ///< r, semi-axis lengths, meters, > 0
};

/// The axes by falling radius; equal ones in their own order.
std::array<int, 3> axes_by_radius(const Vec3& radii);

/// zeta = (p - c)^T Q (p - c), the paper's eq. (9): below 1 inside, 1 on the surface, above 1 outside.
double level(const Ellipsoid& ellipsoid, const Vec3& point);

/// Volume, cubic meters.
double volume(const Ellipsoid& ellipsoid);

/// The tight axis-aligned box.
Box bounding_box(const Ellipsoid& ellipsoid);

/// Where the ray from the center through `point` meets the surface: the paper's v^phi of eq. (6) and its
/// response direction. At the center itself: the end of the shortest semi-axis.
Vec3 radial_projection(const Ellipsoid& ellipsoid, const Vec3& point);

struct ClosestPoint {
  Vec3 point = Vec3::Zero();     ///< on the surface
  Vec3 normal = Vec3::UnitX();   ///< outward unit normal there
  double signed_distance = 0.0;  ///< meters, negative inside
};

/// The exact closest point of the ellipsoid's surface, to a relative error of 1e-12 of the largest radius.
/// Where it is not unique (the medial disk), the one on the positive side of the axis concerned; at the
/// center, the end of the shortest semi-axis. Never NaN for finite input. Cost: a bounded root search.
/// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
ClosestPoint closest_point(const Ellipsoid& ellipsoid, const Vec3& point);

}  // namespace bodice::geometry
