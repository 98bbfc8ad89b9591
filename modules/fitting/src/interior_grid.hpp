#pragma once

#include <utility>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::fitting {

/// A line along y and the stretches of it that lie inside the mesh.
struct InteriorColumn {
  double x = 0.0, z = 0.0;
  std::vector<std::pair<double, double>> inside;  ///< ascending in y
};

/// Columns `spacing_m` apart that meet the inside, counted as in interior_grid(). O(#F + columns).
std::vector<InteriorColumn> interior_columns(const geometry::TriMesh& mesh, double spacing_m);

/// Points of a cubic grid that lie inside the mesh, `spacing_m` apart, by counting signed crossings along
/// columns (above zero is inside, so overlaps stay inside). Columns that do not close (holes) are left out.
/// O(#F + columns); at most about four million grid points, beyond which the spacing is widened.
std::vector<geometry::Vec3> interior_grid(const geometry::TriMesh& mesh, double spacing_m);

}  // namespace bodice::fitting
