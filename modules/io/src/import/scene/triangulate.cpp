// Based on: Gary H. Meisters. Polygons have ears. 1975.
// Differs: among the ears, quads are cut so that both triangles face along the polygon's normal (Newell's),
// which also cuts convex quads. assimp's own step is not used, because it aborts the process on some damaged
// files.
#include "import/scene/triangulate.hpp"

#include <Eigen/Geometry>

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::Triangle;
using geometry::Vec3;

/// Larger polygons are fanned, since cutting ears takes the square of their size.
constexpr std::size_t kLargestCut = 512;

Vec3 newell_normal(std::span<const Vec3> positions, std::span<const Index> polygon) {
  Vec3 normal = Vec3::Zero();
  const Vec3& origin = positions[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal += (positions[polygon[i]] - origin).cross(positions[polygon[i + 1]] - origin);
  return normal;
}

double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return (b - a).cross(c - a).dot(normal);
}

bool is_ear(std::span<const Vec3> positions, const std::vector<Index>& left, std::size_t at,
            const Vec3& normal) {
  const std::size_t n = left.size();
  const Vec3& a = positions[left[(at + n - 1) % n]];
  const Vec3& b = positions[left[at]];
  const Vec3& c = positions[left[(at + 1) % n]];
  if (!(turn(a, b, c, normal) > 0.0)) return false;
  for (std::size_t k = 2; k + 1 < n; ++k) {
    const Vec3& p = positions[left[(at + k) % n]];
    if (turn(a, b, p, normal) >= 0.0 && turn(b, c, p, normal) >= 0.0 && turn(c, a, p, normal) >= 0.0)
      return false;
  }
  return true;
}

void fan(const std::vector<Index>& left, std::vector<Triangle>& triangles) {
  for (std::size_t i = 1; i + 1 < left.size(); ++i) triangles.push_back({left[0], left[i], left[i + 1]});
}

}  // namespace

void triangulate(std::span<const Vec3> positions, std::span<const Index> polygon,
                 std::vector<Triangle>& triangles) {
  std::vector<Index> left(polygon.begin(), polygon.end());
  if (left.size() <= 3 || left.size() > kLargestCut) return fan(left, triangles);
  const Vec3 normal = newell_normal(positions, polygon);
  while (left.size() > 3) {
    std::size_t ear = 1;  // in a convex polygon, cutting corner 1 leaves the fan of corner 0
    while (ear < left.size() && !is_ear(positions, left, ear, normal)) ++ear;
    if (ear == left.size()) ear = 0;
    if (ear == 0 && !is_ear(positions, left, 0, normal)) break;
    const std::size_t n = left.size();
    triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  fan(left, triangles);
}

}  // namespace bodice::io
