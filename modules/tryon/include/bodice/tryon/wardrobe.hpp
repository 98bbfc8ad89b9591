#pragma once

#include <string>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::tryon {

struct WornGarment {
  std::string name;
  geometry::TriMesh mesh;             ///< metres, y up
  std::vector<geometry::Index> held;  ///< vertices that stay with the body
};

/// All garments as one mesh for one solver, and where each begins.
struct Wardrobe {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> held;
  std::vector<std::size_t> first_vertex;  ///< #garments + 1
};

/// Joins the garments, in order. O(vertices).
Wardrobe join(const std::vector<WornGarment>& garments);

}  // namespace bodice::tryon
