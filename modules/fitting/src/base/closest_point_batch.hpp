// Closest points of many points on one ellipsoid at a fixed cost: the inner loop of the anytime tiers.
#pragma once

#include <cstddef>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::fitting {

/// An ellipsoid in floats: y = R^T (x - c); once more in units of its largest radius, so that products of
/// three squared radii stay far from what floats cannot hold.
struct FootEllipsoid {
  float c[3];
  float rt[3][3];  ///< rows of R^T
  float r[3];
  float largest;                 ///< of r
  float to_unit[3][3], unit[3];  ///< rt, r over `largest`
  float squared[3], inverse[3];  ///< unit^2, 1 / unit
  float most_squared, least_squared;

  explicit FootEllipsoid(const geometry::Ellipsoid& e);
};

/// d[i] = signed distance of point i, i < n. Within 1e-5 of the largest radius near the surface; deep inside
/// it may be too shallow. Coordinates of the order of one (scale the problem first). No aliasing.
void foot_distances(const FootEllipsoid& e, std::size_t n, const float* x, const float* y, const float* z,
                    float* d);

/// As foot_distances, and the outward unit normal there.
void foot_normals(const FootEllipsoid& e, std::size_t n, const float* x, const float* y, const float* z,
                  float* d, float* nx, float* ny, float* nz);

/// As foot_distances, and the foot's unit direction w on the sphere in the ellipsoid's frame.
void foot_details(const FootEllipsoid& e, std::size_t n, const float* x, const float* y, const float* z,
                  float* d, float* wx, float* wy, float* wz);

}  // namespace bodice::fitting
