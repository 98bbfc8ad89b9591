// Closest points of many points on one ellipsoid at a fixed cost: the inner loop of the anytime tiers.
#pragma once

#include <bodice/geometry/ellipsoid.hpp>

#include "base/point_arrays.hpp"

namespace bodice::inline v0_1::fitting {

/// An ellipsoid in floats: y = R^T (x - c) maps into its frame. It is also stored in units of its largest
/// radius, so that products of three squared radii neither overflow nor vanish.
struct FloatEllipsoid {
  float c[3];
  float rt[3][3];  ///< rows of R^T
  float r[3];
  float largest;                      ///< the largest of r
  float to_unit[3][3], unit[3];       ///< rt and r, both divided by `largest`
  float squared[3], inverse[3];       ///< unit^2, 1 / unit
  float most_squared, least_squared;  ///< the largest and the least of `squared`

  explicit FloatEllipsoid(const geometry::Ellipsoid& e);
};

/// Writes the signed distance d[i] of each point: within 1e-5 of the largest radius near the surface; deep
/// inside it may be too shallow. Coordinates have to be of the order of one (see Scaling). No arrays overlap.
void batch_distances(const FloatEllipsoid& e, const PointArrays& points, float* d);

/// Writes distances as batch_distances(), and the outward unit normals at the closest points.
void batch_normals(const FloatEllipsoid& e, const PointArrays& points, float* d, float* nx, float* ny,
                   float* nz);

/// Writes the closest points as unit vectors w: c + R (r o w).
void batch_directions(const FloatEllipsoid& e, const PointArrays& points, float* wx, float* wy, float* wz);

}  // namespace bodice::fitting
