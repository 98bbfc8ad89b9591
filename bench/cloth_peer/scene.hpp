// The scene of both solvers: a square sheet over a ball.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

inline constexpr double kFrame_s = 1.0 / 60.0;
inline constexpr int kSubsteps = 8;
inline constexpr int kWarmFrames = 60;  ///< until the sheet is in contact and begins to fold
inline constexpr double kRadius_m = 0.25;
inline constexpr double kThickness_m = 0.002;
inline const bodice::geometry::Vec3 kCenter = {0.0, 1.25, 0.0};

/// A square of side * side particles, 1.2 m wide, a centimeter above the ball.
inline bodice::geometry::TriMesh sheet(int side) {
  bodice::geometry::TriMesh mesh;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      mesh.positions.emplace_back(1.2 * i / (side - 1) - 0.6, kCenter.y() + kRadius_m + 0.01,
                                  1.2 * j / (side - 1) - 0.6);
  for (int j = 0; j + 1 < side; ++j)
    for (int i = 0; i + 1 < side; ++i) {
      const auto a = static_cast<bodice::geometry::Index>(j * side + i),
                 c = a + static_cast<bodice::geometry::Index>(side);
      mesh.triangles.push_back({a, c, a + 1});
      mesh.triangles.push_back({a + 1, c, c + 1});
    }
  return mesh;
}

/// The 95th percentile of the elongation of the triangles' sides, at least 0.
inline double stretch_p95(const bodice::geometry::TriMesh& rest,
                          const std::vector<bodice::geometry::Vec3>& now) {
  std::vector<double> strain;
  for (const auto& t : rest.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      strain.push_back((now[a] - now[b]).norm() / (rest.positions[a] - rest.positions[b]).norm() - 1.0);
    }
  const auto at = strain.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(strain.size() - 1));
  std::nth_element(strain.begin(), at, strain.end());
  return std::max(0.0, *at);
}

/// Depth of the deepest particle in the ball, meters.
inline double deepest_m(const std::vector<bodice::geometry::Vec3>& now) {
  double deepest = 0.0;
  for (const auto& p : now) deepest = std::max(deepest, kRadius_m - (p - kCenter).norm());
  return deepest;
}

}  // namespace bench
