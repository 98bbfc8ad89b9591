#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "base/interior_grid.hpp"
#include "cover/column_lines.hpp"
#include "cover/cover.hpp"
#include "cover/cover_between.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Ellipsoid;
using Stretch = InteriorColumns::Stretch;

/// The ends of a stretch of a column that no ellipsoid covers.
struct Hole {
  Vec3 low, high;
};

/// The holes in the columns of row k.
std::vector<Hole> holes_of_row(const InteriorColumns& columns, int k, const RowCover& row, double shortest) {
  std::vector<Hole> holes;
  std::vector<Stretch> covered, left;
  for (int i = 0; i < columns.nx; ++i) {
    if (columns.at(i, k).empty()) continue;
    covered.clear();
    for (const RowCover::Part& part : row.at(i)) covered.push_back(part.stretch);
    std::sort(covered.begin(), covered.end());
    left.clear();
    for (const Stretch& wanted : columns.at(i, k)) subtract(wanted, covered, shortest, left);
    for (const auto& [low, high] : left)
      holes.push_back({Vec3(columns.x(i), low, columns.z(k)), Vec3(columns.x(i), high, columns.z(k))});
  }
  return holes;
}

/// The holes in all columns; fills in what covers each row.
std::vector<Hole> find_holes(const engine::Context& context, const InteriorColumns& columns,
                             const std::vector<Ellipsoid>& ellipsoids, double shortest,
                             std::vector<RowCover>& cover) {
  const std::vector<ColumnLine> lines(ellipsoids.begin(), ellipsoids.end());
  const auto rows = static_cast<std::size_t>(columns.nz);
  cover.resize(rows);
  std::vector<std::vector<Hole>> of_row(rows);
  constexpr std::size_t kGrain = 4;
  engine::parallel_for(context, rows, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int k = static_cast<int>(row);
      cover[row] = cover_row(columns, k, lines);
      of_row[row] = holes_of_row(columns, k, cover[row], shortest);
    }
  });
  std::vector<Hole> holes;
  for (const auto& row : of_row) holes.insert(holes.end(), row.begin(), row.end());
  return holes;
}

/// The total length of all columns inside the body.
double interior_length_m(const InteriorColumns& columns) {
  double sum = 0.0;
  for (const auto& [low, high] : columns.inside) sum += high - low;
  return sum;
}

/// How far a point is outside the ellipsoid along the ray from the center; zero inside.
double ray_outside(const Ellipsoid& e, const Vec3& p) {
  const double level = geometry::level(e, p);
  return level > 1.0 ? (p - e.center).norm() * (1.0 - 1.0 / std::sqrt(level)) : 0.0;
}

/// Whether the point is certainly farther than `least` outside the ellipsoid along the ray from the center:
/// it is so far outside the enclosing ball.
bool certainly_farther(const Ellipsoid& e, const Vec3& p, double least) {
  constexpr double kRounding = 1e-12;
  const double distance = (p - e.center).norm();
  return distance - e.radii.maxCoeff() > least + kRounding * distance;
}

/// Stretches the ellipsoid that is nearest to all of the points until it holds them.
void fill(std::span<const Vec3> points, std::vector<Ellipsoid>& ellipsoids) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < ellipsoids.size() && least > 0.0; ++e) {
    if (certainly_farther(ellipsoids[e], points.front(), least)) continue;
    double outside = 0.0;
    for (const Vec3& p : points) outside = std::max(outside, ray_outside(ellipsoids[e], p));
    if (outside < least) least = outside, best = e;
  }
  for (const Vec3& p : points) ellipsoids[best] = stretched(ellipsoids[best], p);
}

/// Calls f(low, high) for pieces of a line that are not much longer than `length`.
template <class F>
void for_each_piece(const Vec3& low, const Vec3& high, double length, F&& f) {
  const int pieces = std::clamp(static_cast<int>((high - low).norm() / length), 1, 1000);
  const auto at = [&](int k) { return Vec3(low + (high - low) * k / pieces); };
  for (int i = 0; i < pieces; ++i) f(at(i), at(i + 1));
}

std::array<Vec3, 8> corners_of(const geometry::Box& box) {
  std::array<Vec3, 8> corners;
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (int j = 0; j < 3; ++j) corners[c][j] = (c >> j) & 1 ? box.high[j] : box.low[j];
  return corners;
}

}  // namespace

double cover_interior(const engine::Context& context, const InteriorColumns& columns,
                      const geometry::MeshDistance& distance, std::vector<Ellipsoid>& ellipsoids) {
  const double spacing_m = columns.spacing_m;
  double length_m = 0.0;
  if (ellipsoids.empty()) return length_m;
  std::vector<RowCover> cover;
  for (const Hole& hole : find_holes(context, columns, ellipsoids, 1e-3 * spacing_m, cover)) {
    context.checkpoint();
    length_m += hole.high.y() - hole.low.y();
    for_each_piece(hole.low, hole.high, spacing_m, [&](const Vec3& low, const Vec3& high) {
      fill(std::array{low, high}, ellipsoids);
    });
  }
  // The rows' covers remain valid, because a stretched ellipsoid holds all that it held. After much
  // stretching they hold far more, and without an update nearly the whole interior would be unsure.
  constexpr double kMuch = 0.1;
  if (length_m > kMuch * interior_length_m(columns))
    find_holes(context, columns, ellipsoids, 1e-3 * spacing_m, cover);
  for (const geometry::Box& box : unsure_between(context, columns, cover, ellipsoids)) {
    context.checkpoint();
    const Vec3 middle = box.center(), up = 0.5 * box.size().y() * Vec3::UnitY(),
               aside = middle + up - box.high;
    for_each_piece(middle - up, middle + up, spacing_m, [&](const Vec3& low, const Vec3& high) {
      // Columns on either side of a narrow gap, as between fingers, leave open whether a point in it is
      // inside.
      if (!distance.inside(0.5 * (low + high))) return;
      geometry::Box piece;
      piece.extend(low + aside);
      piece.extend(high - aside);
      fill(corners_of(piece), ellipsoids);
    });
  }
  return length_m;
}

}  // namespace bodice::fitting
