#include "interior_grid.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::fitting {
namespace {

using geometry::Vec3;

struct Crossing {
  double y;
  int sign;  ///< +1 where the column enters, seen from below
};

struct Columns {
  Vec3 low;
  double spacing;
  int nx, nz;
  std::vector<std::vector<Crossing>> crossings;

  double x(int i) const { return low.x() + (i + 0.5) * spacing; }
  double z(int k) const { return low.z() + (k + 0.5) * spacing; }
};

/// Twice the signed area of (a, b, p) in the xz plane; a point on a shared edge falls to one side only.
double edge(const Vec3& a, const Vec3& b, double x, double z) {
  return (b.x() - a.x()) * (z - a.z()) - (b.z() - a.z()) * (x - a.x());
}

void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, Columns& columns) {
  const double area = edge(a, b, c.x(), c.z());
  if (area == 0.0) return;
  const auto range = [&](double low, double high, double origin, int n) {
    const double first = std::ceil((low - origin) / columns.spacing - 0.5);
    const double last = std::floor((high - origin) / columns.spacing - 0.5);
    return std::pair(std::max(0, static_cast<int>(first)), std::min(n - 1, static_cast<int>(last)));
  };
  const auto [i0, i1] =
      range(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), columns.low.x(), columns.nx);
  const auto [k0, k1] =
      range(std::min({a.z(), b.z(), c.z()}), std::max({a.z(), b.z(), c.z()}), columns.low.z(), columns.nz);
  for (int k = k0; k <= k1; ++k)
    for (int i = i0; i <= i1; ++i) {
      const double x = columns.x(i), z = columns.z(k);
      const double u = edge(b, c, x, z) / area, v = edge(c, a, x, z) / area, w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      const double y = u * a.y() + v * b.y() + w * c.y();
      columns.crossings[static_cast<std::size_t>(k * columns.nx + i)].push_back({y, area > 0.0 ? 1 : -1});
    }
}

/// The stretches where the count of signed crossings is above zero; none if the column does not close.
std::vector<std::pair<double, double>> stretches(std::vector<Crossing>& column) {
  std::vector<std::pair<double, double>> inside;
  std::sort(column.begin(), column.end(), [](const Crossing& a, const Crossing& b) { return a.y < b.y; });
  int depth = 0;
  for (const Crossing& c : column) {
    const int before = depth;
    depth += c.sign;
    if (before <= 0 && depth > 0) inside.emplace_back(c.y, c.y);
    if (before > 0 && depth <= 0) inside.back().second = c.y;
  }
  return depth == 0 ? inside : std::vector<std::pair<double, double>>{};
}

Columns make_columns(const geometry::TriMesh& mesh, const geometry::Box& box, double spacing_m) {
  const Vec3 size = box.size().cwiseMax(1e-9 * box.size().maxCoeff());
  // An irrational shift keeps columns off the vertices of symmetric meshes.
  const Vec3 low = box.low - Vec3(0.3819660, 0.2360680, 0.4142136) * spacing_m;
  Columns columns{low,
                  spacing_m,
                  static_cast<int>(size.x() / spacing_m) + 2,
                  static_cast<int>(size.z() / spacing_m) + 2,
                  {}};
  columns.crossings.resize(static_cast<std::size_t>(columns.nx) * static_cast<std::size_t>(columns.nz));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    add_triangle(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), columns);
  return columns;
}

std::vector<InteriorColumn> inside_of(Columns& columns) {
  std::vector<InteriorColumn> result;
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i) {
      auto inside = stretches(columns.crossings[static_cast<std::size_t>(k * columns.nx + i)]);
      if (!inside.empty()) result.push_back({columns.x(i), columns.z(k), std::move(inside)});
    }
  return result;
}

/// The spacing that keeps the grid below its limits.
double bounded_spacing(const geometry::Box& box, double spacing_m) {
  constexpr double kMostPoints = 4e6;
  const Vec3 size = box.size().cwiseMax(1e-9 * box.size().maxCoeff());
  return std::max({spacing_m, std::cbrt(size.prod() / kMostPoints), size.maxCoeff() / 2000.0});
}

}  // namespace

std::vector<InteriorColumn> interior_columns(const geometry::TriMesh& mesh, double spacing_m) {
  const geometry::Box box = geometry::bounding_box(mesh.positions);
  if (box.empty() || !(spacing_m > 0.0)) return {};
  Columns columns = make_columns(mesh, box, bounded_spacing(box, spacing_m));
  return inside_of(columns);
}

std::vector<Vec3> interior_grid(const geometry::TriMesh& mesh, double spacing_m) {
  std::vector<Vec3> points;
  const geometry::Box box = geometry::bounding_box(mesh.positions);
  if (box.empty() || !(spacing_m > 0.0)) return points;
  Columns columns = make_columns(mesh, box, bounded_spacing(box, spacing_m));
  const double step = columns.spacing, low_y = columns.low.y();
  for (const InteriorColumn& column : inside_of(columns))
    for (const auto& [from, to] : column.inside)
      for (double j = std::ceil((from - low_y) / step - 0.5); low_y + (j + 0.5) * step < to; j += 1.0)
        points.emplace_back(column.x, low_y + (j + 0.5) * step, column.z);
  return points;
}

}  // namespace bodice::fitting
