#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::fitting {

/// Points of a cubic grid that lie inside the mesh, `spacing_m` apart, by counting signed crossings along
/// columns (above zero is inside, so overlaps stay inside). Columns that do not close (holes) are left out.
/// O(#F + columns); at most about four million grid points, beyond which the spacing is widened.
std::vector<geometry::Vec3> interior_grid(const geometry::TriMesh& mesh, double spacing_m);

}  // namespace bodice::fitting
