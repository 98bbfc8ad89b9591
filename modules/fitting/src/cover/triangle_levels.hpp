// How far the triangles of a batch reach out of one ellipsoid: the inner loop of covers, alone in its file so
// that it can be compiled for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

#include <bodice/geometry/ellipsoid.hpp>

namespace bodice::inline v0_1::fitting {

/// A point with a level below this is inside, whatever the rounding of the stored radii.
inline constexpr double kInside = 1.0 - 1e-12;

/// Triangles as structure of arrays.
struct TriangleBatch {
  static constexpr std::size_t kMost = 256;  ///< fits into the first-level cache, with a row of results
  std::size_t count = 0;
  double at[9][kMost];  ///< x, y, z of the first corner, then of the second and of the third

  void add(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c) {
    for (int j = 0; j < 3; ++j) at[j][count] = a[j], at[3 + j][count] = b[j], at[6 + j][count] = c[j];
    ++count;
  }
};

/// An ellipsoid in the form level(p) = |whiten (p - center)|^2.
struct LevelForm {
  double center[3], whiten[3][3];
  explicit LevelForm(const geometry::Ellipsoid& e);
};

/// Writes the largest level of each triangle's corners. It is at most 1 where the ellipsoid holds the whole
/// triangle, by convexity.
void worst_levels(const LevelForm& e, const TriangleBatch& triangles, double* level);

/// The ellipsoid of each triangle of a batch: the first one that holds it, else the one that has to grow
/// least for it.
struct TriangleHomes {
  float growth_m[TriangleBatch::kMost];  ///< the growth needed to hold the triangle; negative: it is held
  std::uint32_t ellipsoid[TriangleBatch::kMost];

  void clear(std::size_t count);
  bool all_held(std::size_t count) const;
  bool held(std::size_t i) const { return growth_m[i] < 0.0f; }
};

/// Makes an ellipsoid the home of those triangles that it holds, or has to grow less for than their homes so
/// far. Growth is the length of the ray outside. Call it with ascending numbers, so that ties go to the
/// lowest.
void offer_home(const LevelForm& e, std::uint32_t number, const TriangleBatch& triangles,
                TriangleHomes& homes);

}  // namespace bodice::fitting
