#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "cover.hpp"
#include "interior_grid.hpp"

namespace bodice::fitting {
namespace {

using geometry::Ellipsoid;
using Stretch = std::pair<double, double>;

/// An ellipsoid made ready for lines along y.
struct Line {
  geometry::Box box;
  geometry::Mat3 whiten;
  Vec3 center;

  explicit Line(const Ellipsoid& e)
      : box(geometry::bounding_box(e)),
        whiten(e.radii.cwiseInverse().asDiagonal() * e.axes.transpose()),
        center(e.center) {}

  /// The stretch of the line through (x, z) inside the ellipsoid; empty (first > second) if there is none.
  Stretch inside(double x, double z) const {
    constexpr Stretch kNone{1.0, 0.0};
    if (x < box.low.x() || x > box.high.x() || z < box.low.z() || z > box.high.z()) return kNone;
    const Vec3 along = whiten.col(1), from = whiten * Vec3(x - center.x(), 0.0, z - center.z());
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - 1.0;
    const double root = b * b - a * c;
    if (!(root > 0.0)) return kNone;
    const double half = std::sqrt(root);
    return {center.y() + (-b - half) / a, center.y() + (-b + half) / a};
  }
};

struct Hole {
  Vec3 low, high;  // ends of a stretch that no ellipsoid covers
};

/// What `wanted` has that none of the `covered` stretches (sorted by their begin) has.
void subtract(const Stretch& wanted, const std::vector<Stretch>& covered, const InteriorColumn& column,
              double shortest, std::vector<Hole>& holes) {
  double from = wanted.first;
  const auto note = [&](double to) {
    if (to - from > shortest) holes.push_back({Vec3(column.x, from, column.z), Vec3(column.x, to, column.z)});
  };
  for (const auto& [begin, end] : covered) {
    if (end <= from) continue;
    if (begin >= wanted.second) break;
    note(begin);
    from = end;
    if (from >= wanted.second) return;
  }
  note(wanted.second);
}

std::vector<Hole> find_holes(const engine::Context& context, const std::vector<InteriorColumn>& columns,
                             const std::vector<Ellipsoid>& ellipsoids, double shortest) {
  const std::vector<Line> lines(ellipsoids.begin(), ellipsoids.end());
  constexpr std::size_t kGrain = 256;
  std::vector<std::vector<Hole>> of_block(engine::block_count(columns.size(), kGrain));
  engine::parallel_for(context, columns.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Stretch> covered;
    for (std::size_t c = begin; c < end; ++c) {
      covered.clear();
      for (const Line& line : lines) {
        const Stretch s = line.inside(columns[c].x, columns[c].z);
        if (s.first < s.second) covered.push_back(s);
      }
      std::sort(covered.begin(), covered.end());
      for (const Stretch& wanted : columns[c].inside)
        subtract(wanted, covered, columns[c], shortest, of_block[begin / kGrain]);
    }
  });
  std::vector<Hole> holes;
  for (const auto& block : of_block) holes.insert(holes.end(), block.begin(), block.end());
  return holes;
}

/// How far the point is outside, along its ray.
double ray_outside(const Ellipsoid& e, const Vec3& p) {
  const double level = geometry::level(e, p);
  return level > 1.0 ? (p - e.center).norm() * (1.0 - 1.0 / std::sqrt(level)) : 0.0;
}

/// Stretches the ellipsoid that has to grow least over the hole's piece.
void fill(const Vec3& low, const Vec3& high, std::vector<Ellipsoid>& ellipsoids) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < ellipsoids.size(); ++e) {
    const double outside = std::max(ray_outside(ellipsoids[e], low), ray_outside(ellipsoids[e], high));
    if (outside < least) least = outside, best = e;
  }
  ellipsoids[best] = stretched(stretched(ellipsoids[best], low), high);
}

}  // namespace

double cover_interior(const engine::Context& context, const geometry::TriMesh& mesh, double spacing_m,
                      std::vector<Ellipsoid>& ellipsoids) {
  double length_m = 0.0;
  if (ellipsoids.empty()) return length_m;
  const auto columns = interior_columns(mesh, spacing_m);
  for (const Hole& hole : find_holes(context, columns, ellipsoids, 1e-3 * spacing_m)) {
    context.checkpoint();
    const double height = hole.high.y() - hole.low.y();
    length_m += height;
    const int pieces = std::clamp(static_cast<int>(height / spacing_m), 1, 1000);
    for (int i = 0; i < pieces; ++i) {
      const auto at = [&](int k) { return Vec3(hole.low + (hole.high - hole.low) * k / pieces); };
      fill(at(i), at(i + 1), ellipsoids);
    }
  }
  return length_m;
}

}  // namespace bodice::fitting
