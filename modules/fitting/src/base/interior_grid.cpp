#include "base/interior_grid.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::fitting {
namespace {

using geometry::Vec3;

/// A triangle crossed by a column.
struct Crossing {
  std::uint32_t cell;
  int sign;  ///< +1 where the column enters the body, followed upward; else -1
  double y;
};

/// Twice the signed area of (a, b, p) in the xz plane. A point on a shared edge belongs to one of the
/// triangles only.
double edge(const Vec3& a, const Vec3& b, double x, double z) {
  return (b.x() - a.x()) * (z - a.z()) - (b.z() - a.z()) * (x - a.x());
}

void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const InteriorColumns& columns,
                  std::vector<Crossing>& crossings) {
  const double area = edge(a, b, c.x(), c.z());
  if (area == 0.0) return;
  const auto [i0, i1] = cells_within(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}),
                                     columns.low.x(), columns.spacing_m, columns.nx);
  const auto [k0, k1] = cells_within(std::min({a.z(), b.z(), c.z()}), std::max({a.z(), b.z(), c.z()}),
                                     columns.low.z(), columns.spacing_m, columns.nz);
  for (int k = k0; k <= k1; ++k)
    for (int i = i0; i <= i1; ++i) {
      const double x = columns.x(i), z = columns.z(k);
      const double u = edge(b, c, x, z) / area, v = edge(c, a, x, z) / area, w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      const double y = u * a.y() + v * b.y() + w * c.y();
      crossings.push_back({static_cast<std::uint32_t>(columns.cell(i, k)), area > 0.0 ? 1 : -1, y});
    }
}

/// Appends the stretches where the count of signed crossings is above zero, or none if the crossings do not
/// add up to zero.
void add_stretches(std::span<Crossing> column, std::vector<InteriorColumns::Stretch>& inside) {
  std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.y < b.y; });
  const std::size_t before_column = inside.size();
  int depth = 0;
  for (const Crossing& c : column) {
    const int before = depth;
    depth += c.sign;
    if (before <= 0 && depth > 0) inside.emplace_back(c.y, c.y);
    if (before > 0 && depth <= 0) inside.back().second = c.y;
  }
  if (depth != 0) inside.resize(before_column);
}

/// The crossings sorted by cell, in their order within a cell. Fills in `begin` (#cells + 1): where each
/// cell's begin.
std::vector<Crossing> by_cell(const std::vector<Crossing>& crossings, std::vector<std::uint32_t>& begin) {
  for (const Crossing& c : crossings) ++begin[c.cell + 1];
  for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
  std::vector<Crossing> sorted(crossings.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const Crossing& c : crossings) sorted[next[c.cell]++] = c;
  return sorted;
}

void fill_columns(const geometry::TriMesh& mesh, InteriorColumns& columns) {
  std::vector<Crossing> crossings;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    add_triangle(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), columns, crossings);
  columns.begin.assign(columns.cell(0, columns.nz) + 1, 0);
  std::vector<std::uint32_t> of_cell = columns.begin;
  crossings = by_cell(crossings, of_cell);
  for (std::size_t c = 0; c + 1 < of_cell.size(); ++c) {
    add_stretches(std::span(crossings).subspan(of_cell[c], of_cell[c + 1] - of_cell[c]), columns.inside);
    columns.begin[c + 1] = static_cast<std::uint32_t>(columns.inside.size());
  }
}

/// The spacing that keeps the grid below its limits.
double bounded_spacing(const geometry::Box& box, double spacing_m) {
  constexpr double kMostPoints = 4e6;
  const Vec3 size = box.size().cwiseMax(1e-9 * box.size().maxCoeff());
  return std::max({spacing_m, std::cbrt(size.prod() / kMostPoints), size.maxCoeff() / 2000.0});
}

}  // namespace

std::pair<int, int> cells_within(double low, double high, double origin, double spacing, int n) {
  const double first = std::ceil((low - origin) / spacing - 0.5);
  const double last = std::floor((high - origin) / spacing - 0.5);
  const auto bounded = [n](double i) {
    return static_cast<int>(std::clamp(i, -1.0, static_cast<double>(n)));
  };
  return {std::max(0, bounded(first)), std::min(n - 1, bounded(last))};
}

InteriorColumns interior_columns(const geometry::TriMesh& mesh, double spacing_m) {
  InteriorColumns columns;
  const geometry::Box box = geometry::bounding_box(mesh.positions);
  if (box.empty() || !(spacing_m > 0.0)) return columns;
  columns.spacing_m = bounded_spacing(box, spacing_m);
  const Vec3 size = box.size().cwiseMax(1e-9 * box.size().maxCoeff());
  // An irrational shift keeps columns off the vertices of symmetric meshes.
  columns.low = box.low - Vec3(0.3819660, 0.2360680, 0.4142136) * columns.spacing_m;
  columns.nx = static_cast<int>(size.x() / columns.spacing_m) + 2;
  columns.nz = static_cast<int>(size.z() / columns.spacing_m) + 2;
  fill_columns(mesh, columns);
  return columns;
}

std::vector<Vec3> interior_grid(const geometry::TriMesh& mesh, double spacing_m) {
  std::vector<Vec3> points;
  const InteriorColumns columns = interior_columns(mesh, spacing_m);
  const double step = columns.spacing_m, low_y = columns.low.y();
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i)
      for (const auto& [from, to] : columns.at(i, k))
        for (double j = std::ceil((from - low_y) / step - 0.5); low_y + (j + 0.5) * step < to; j += 1.0)
          points.emplace_back(columns.x(i), low_y + (j + 0.5) * step, columns.z(k));
  return points;
}

}  // namespace bodice::fitting
