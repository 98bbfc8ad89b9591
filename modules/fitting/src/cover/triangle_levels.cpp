#include "cover/triangle_levels.hpp"

#include <algorithm>

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

constexpr std::size_t kMost = TriangleBatch::kMost;

[[gnu::always_inline]] inline double larger(double a, double b) {
  return a < b ? b : a;
}

struct Offset {
  double x, y, z;
};

[[gnu::always_inline]] inline double level_of(const LevelForm& e, const Offset& d) {
  const double u = e.whiten[0][0] * d.x + e.whiten[0][1] * d.y + e.whiten[0][2] * d.z;
  const double v = e.whiten[1][0] * d.x + e.whiten[1][1] * d.y + e.whiten[1][2] * d.z;
  const double w = e.whiten[2][0] * d.x + e.whiten[2][1] * d.y + e.whiten[2][2] * d.z;
  return u * u + v * v + w * w;
}

[[gnu::always_inline]] inline Offset offset(const LevelForm& e, const TriangleBatch& t, int corner,
                                            std::size_t i) {
  return {t.at[3 * corner][i] - e.center[0], t.at[3 * corner + 1][i] - e.center[1],
          t.at[3 * corner + 2][i] - e.center[2]};
}

[[gnu::always_inline]] inline double worst_level(const LevelForm& e, const TriangleBatch& t, std::size_t i) {
  const double a = level_of(e, offset(e, t, 0, i)), b = level_of(e, offset(e, t, 1, i));
  return larger(larger(a, b), level_of(e, offset(e, t, 2, i)));
}

}  // namespace

LevelForm::LevelForm(const geometry::Ellipsoid& e) {
  for (int j = 0; j < 3; ++j) {
    center[j] = e.center[j];
    for (int i = 0; i < 3; ++i) whiten[j][i] = e.axes(i, j) / e.radii[j];
  }
}

BODICE_CLONES void worst_levels(const LevelForm& ellipsoid, const TriangleBatch& triangles,
                                double* __restrict level) {
  const LevelForm e = ellipsoid;
  const std::size_t n = triangles.count;
  for (std::size_t i = 0; i < n; ++i) level[i] = worst_level(e, triangles, i);
}

void TriangleHomes::clear(std::size_t count) {
  std::fill_n(growth_m, count, __builtin_inff());
  std::fill_n(ellipsoid, count, 0u);
}

bool TriangleHomes::all_held(std::size_t count) const {
  return *std::max_element(growth_m, growth_m + count) < 0.0f;
}

BODICE_CLONES void offer_home(const LevelForm& ellipsoid, std::uint32_t number,
                              const TriangleBatch& triangles, TriangleHomes& homes) {
  const LevelForm e = ellipsoid;
  const std::size_t n = triangles.count;
  float outside[kMost], ray_squared[kMost];  // outside: level - 1, which keeps its digits near the surface
  for (std::size_t i = 0; i < n; ++i) {
    const double level = worst_level(e, triangles, i);
    const Offset d = offset(e, triangles, 0, i);
    outside[i] = level <= kInside ? -1.0f : static_cast<float>(larger(level - 1.0, 0.0));
    ray_squared[i] = static_cast<float>(d.x * d.x + d.y * d.y + d.z * d.z);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const float s = outside[i] < 0.0f ? 0.0f : outside[i];
    const float root = __builtin_sqrtf(1.0f + s);
    // |p - c| (1 - 1 / sqrt(level)), without cancellation near the surface.
    const float growth = __builtin_sqrtf(ray_squared[i]) * (s / (root * (root + 1.0f)));
    const float g = outside[i] < 0.0f ? -1.0f : growth;
    const bool better = g < homes.growth_m[i];
    homes.ellipsoid[i] = better ? number : homes.ellipsoid[i];
    homes.growth_m[i] = better ? g : homes.growth_m[i];
  }
}

}  // namespace bodice::fitting
