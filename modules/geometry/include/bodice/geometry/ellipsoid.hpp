#pragma once

#include <array>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// The solid ellipsoid { c + R diag(r) u : |u| <= 1 }.
struct Ellipsoid {
  Vec3 center = Vec3::Zero();    ///< c, meters
  Mat3 axes = Mat3::Identity();  ///< R, columns are the unit semi-axis directions, right-handed
  Vec3 radii = Vec3::Ones();     ///< r, semi-axis lengths, meters, > 0
};

/// The axes by falling radius; equal ones stay in the order of their numbers.
std::array<int, 3> axes_by_radius(const Vec3& radii);

/// The level zeta = (p - c)^T Q (p - c) of the paper's eq. (9): below 1 inside, 1 on the surface, above 1
/// outside.
double level(const Ellipsoid& ellipsoid, const Vec3& point);

/// The volume, in cubic meters.
double volume(const Ellipsoid& ellipsoid);

/// The least axis-aligned box that contains the ellipsoid.
Box bounding_box(const Ellipsoid& ellipsoid);

/// The point where the ray from the center through `point` meets the surface: v^phi of the paper's eq. (6),
/// which is also the direction of its response. At the center itself it is the end of the shortest semi-axis.
Vec3 radial_projection(const Ellipsoid& ellipsoid, const Vec3& point);

/// The closest point of a surface to some point, with the signed distance between them.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();     ///< on the surface
  Vec3 normal = Vec3::UnitX();   ///< outward unit normal there
  double signed_distance = 0.0;  ///< meters, negative inside
};

/// The exact closest point of the ellipsoid's surface; its error is at most 1e-12 of the largest radius.
/// Where it is not unique (on the medial disk), the one on the positive side of the axis concerned is taken;
/// at the center, the end of the shortest semi-axis. The result is never NaN for finite input. Cost: a
/// bounded root search, 2 to 4 steps near the surface. The derivation stands in modules/geometry/README.md.
/// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
ClosestPoint closest_point(const Ellipsoid& ellipsoid, const Vec3& point);

}  // namespace bodice::geometry
