// Nearest points of many points on one ellipsoid at a fixed cost: the inner loop of the anytime tiers.
#pragma once

#include <cstddef>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::fitting {

/// An ellipsoid in floats: y = R^T (x - c).
struct FootEllipsoid {
  float c[3];
  float rt[3][3];  ///< rows of R^T
  float r[3];

  explicit FootEllipsoid(const geometry::Ellipsoid& e) {
    for (int j = 0; j < 3; ++j) {
      c[j] = static_cast<float>(e.center[j]);
      r[j] = static_cast<float>(e.radii[j]);
      for (int i = 0; i < 3; ++i) rt[j][i] = static_cast<float>(e.axes(i, j));
    }
  }
};

/// d[i] = signed distance of point i, i < n. Within 1e-5 of the largest radius near the surface; deep inside
/// it may be too shallow. Coordinates of the order of one (scale the problem first). No aliasing.
void foot_distances(const FootEllipsoid& e, std::size_t n, const float* x, const float* y, const float* z,
                    float* d);

/// As foot_distances, and the foot's unit direction w on the sphere in the ellipsoid's frame.
void foot_details(const FootEllipsoid& e, std::size_t n, const float* x, const float* y, const float* z,
                  float* d, float* wx, float* wy, float* wz);

}  // namespace bodice::fitting
