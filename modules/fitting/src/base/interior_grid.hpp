#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::fitting {

/// Lines along y on a grid of nx x nz cells (some millions at most), each with its stretches that lie inside
/// a mesh.
struct InteriorColumns {
  using Stretch = std::pair<double, double>;  ///< an interval of y, ascending

  geometry::Vec3 low = geometry::Vec3::Zero();
  double spacing_m = 0.0;
  int nx = 0, nz = 0;
  std::vector<std::uint32_t> begin;  ///< nx nz + 1, into inside; x runs fastest
  std::vector<Stretch> inside;

  double x(int i) const { return low.x() + (i + 0.5) * spacing_m; }
  double z(int k) const { return low.z() + (k + 0.5) * spacing_m; }
  std::size_t cell(int i, int k) const { return static_cast<std::size_t>(k * nx + i); }
  std::span<const Stretch> at(int i, int k) const {
    const std::size_t c = cell(i, k);
    return std::span(inside).subspan(begin[c], begin[c + 1] - begin[c]);
  }
};

/// The first and the last of the cells with middles within [low, high], along an axis of `n` cells; none
/// if first > last.
std::pair<int, int> cells_within(double low, double high, double origin, double spacing, int n);

/// Columns `spacing_m` apart, with the stretches that interior_grid() takes points from; none without
/// vertices. O(#F + columns).
InteriorColumns interior_columns(const geometry::TriMesh& mesh, double spacing_m);

/// Points of a cubic grid, `spacing_m` apart, that lie inside the mesh. Signed crossings are counted along
/// columns: a count above zero is inside, so that overlaps are inside too. Columns through holes of the mesh
/// have no points. O(#F + columns). The spacing is widened to keep the grid below four million points.
std::vector<geometry::Vec3> interior_grid(const geometry::TriMesh& mesh, double spacing_m);

}  // namespace bodice::fitting
