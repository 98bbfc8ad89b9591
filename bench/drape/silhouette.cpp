#include "silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bench {
namespace {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

constexpr double kSlice_m = 0.01;
constexpr int kSamples = 8;  // samples of each side, so that a coarse mesh has no gaps

/// The extent of a row of an outline.
struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};
using Outline = std::map<int, Interval>;  // by row

Outline outline(const TriMesh& mesh, int axis) {
  Outline rows;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      for (int s = 0; s < kSamples; ++s) {
        const double at = static_cast<double>(s) / kSamples;
        const Vec3 p = (1.0 - at) * mesh.corner(t, k) + at * mesh.corner(t, (k + 1) % 3);
        Interval& row = rows[static_cast<int>(std::floor(p.y() / kSlice_m))];
        row.low = std::min(row.low, p[axis]), row.high = std::max(row.high, p[axis]);
      }
  return rows;
}

double distance(double at, int row, const Outline& to) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [other, interval] : to) {
    const double aside = std::max({0.0, interval.low - at, at - interval.high});
    nearest = std::min(nearest, std::hypot(aside, kSlice_m * (other - row)));
  }
  return nearest;
}

/// How far `from` reaches beyond `to`.
double beyond(const Outline& from, const Outline& to) {
  double most = 0.0;
  for (const auto& [row, interval] : from)
    most = std::max({most, distance(interval.low, row, to), distance(interval.high, row, to)});
  return most;
}

}  // namespace

double outline_difference_m(const TriMesh& a, const TriMesh& b) {
  double most = 0.0;
  for (const int axis : {0, 2}) {
    const Outline first = outline(a, axis), second = outline(b, axis);
    most = std::max({most, beyond(first, second), beyond(second, first)});
  }
  return most;
}

}  // namespace bench
