// How far a batch of triangles reaches out of one ellipsoid: the inner loop of covers, alone in its file so
// that it can be compiled for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::fitting {

/// Levels below this stay inside under rounding of the stored radii.
inline constexpr double kInside = 1.0 - 1e-12;

/// Triangles as structure of arrays.
struct TriangleBatch {
  static constexpr std::size_t kMost = 256;  // what the nearest cache holds beside a row of results
  std::size_t count = 0;
  double at[9][kMost];  ///< x, y, z of the first corner, of the second, of the third

  void add(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c) {
    for (int j = 0; j < 3; ++j) at[j][count] = a[j], at[3 + j][count] = b[j], at[6 + j][count] = c[j];
    ++count;
  }
};

/// An ellipsoid made ready: level(p) = |whiten (p - center)|^2.
struct LevelForm {
  double center[3], whiten[3][3];
  explicit LevelForm(const geometry::Ellipsoid& e);
};

/// The largest level of each triangle's corners: at most 1 where the ellipsoid, which is convex, holds it.
void worst_levels(const LevelForm& e, const TriangleBatch& triangles, double* level);

/// Which ellipsoid each triangle of a batch belongs to: the first one that holds it, else the one that has to
/// grow least for it.
struct TriangleHomes {
  float growth_m[TriangleBatch::kMost];  ///< negative: held
  std::uint32_t ellipsoid[TriangleBatch::kMost];

  void clear(std::size_t count);
  bool all_held(std::size_t count) const;
  bool held(std::size_t i) const { return growth_m[i] < 0.0f; }
};

/// Offers the triangles an ellipsoid, by the length of ray outside it; ascending numbers keep ties stable.
void offer_home(const LevelForm& e, std::uint32_t number, const TriangleBatch& triangles,
                TriangleHomes& homes);

}  // namespace bodice::fitting
