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
using Stretch = InteriorColumns::Stretch;

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

/// A covered stretch of one column of a row.
struct Covered {
  int column;
  Stretch stretch;
};

/// Every stretch of row k that an ellipsoid covers where the body is, by column and begin.
void cover_row(const InteriorColumns& columns, int k, std::span<const Line> lines,
               std::vector<Covered>& covered) {
  covered.clear();
  const double z = columns.z(k);
  for (const Line& line : lines) {
    if (z < line.box.low.z() || z > line.box.high.z()) continue;
    const auto [first, last] =
        cells_within(line.box.low.x(), line.box.high.x(), columns.low.x(), columns.spacing_m, columns.nx);
    for (int i = first; i <= last; ++i) {
      if (columns.at(i, k).empty()) continue;
      const Stretch s = line.inside(columns.x(i), z);
      if (s.first < s.second) covered.push_back({i, s});
    }
  }
  std::sort(covered.begin(), covered.end(), [](const Covered& a, const Covered& b) {
    return a.column != b.column ? a.column < b.column : a.stretch < b.stretch;
  });
}

/// What `wanted` has that none of the `covered` stretches (sorted by their begin) has.
void subtract(const Stretch& wanted, std::span<const Covered> covered, double x, double z, double shortest,
              std::vector<Hole>& holes) {
  double from = wanted.first;
  const auto note = [&](double to) {
    if (to - from > shortest) holes.push_back({Vec3(x, from, z), Vec3(x, to, z)});
  };
  for (const Covered& c : covered) {
    const auto& [begin, end] = c.stretch;
    if (end <= from) continue;
    if (begin >= wanted.second) break;
    note(begin);
    from = end;
    if (from >= wanted.second) return;
  }
  note(wanted.second);
}

std::vector<Hole> find_holes(const engine::Context& context, const InteriorColumns& columns,
                             const std::vector<Ellipsoid>& ellipsoids, double shortest) {
  const std::vector<Line> lines(ellipsoids.begin(), ellipsoids.end());
  const auto rows = static_cast<std::size_t>(columns.nz);
  std::vector<std::vector<Hole>> of_row(rows);
  constexpr std::size_t kGrain = 8;
  engine::parallel_for(context, rows, kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Covered> covered;
    for (std::size_t row = begin; row < end; ++row) {
      const int k = static_cast<int>(row);
      cover_row(columns, k, lines, covered);
      std::span<const Covered> rest = covered;
      for (int i = 0; i < columns.nx; ++i) {
        std::size_t own = 0;
        while (own < rest.size() && rest[own].column == i) ++own;
        for (const Stretch& wanted : columns.at(i, k))
          subtract(wanted, rest.first(own), columns.x(i), columns.z(k), shortest, of_row[row]);
        rest = rest.subspan(own);
      }
    }
  });
  std::vector<Hole> holes;
  for (const auto& row : of_row) holes.insert(holes.end(), row.begin(), row.end());
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

double cover_interior(const engine::Context& context, const InteriorColumns& columns,
                      std::vector<Ellipsoid>& ellipsoids) {
  const double spacing_m = columns.spacing_m;
  double length_m = 0.0;
  if (ellipsoids.empty()) return length_m;
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
