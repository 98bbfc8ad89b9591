#include "drop_fins.hpp"

#include <algorithm>

namespace bodice::anatomy {

using geometry::Index;

geometry::TriMesh drop_fins(const Skin& skin) {
  std::vector<Index> triangles_at(skin.edges.ends.size(), 0);
  for (const auto& edges : skin.edges.of_triangle)
    for (const Index e : edges) ++triangles_at[e];
  geometry::TriMesh kept{skin.mesh.positions, {}};
  for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
    const auto& edges = skin.edges.of_triangle[f];
    const auto open =
        std::count_if(edges.begin(), edges.end(), [&](Index e) { return triangles_at[e] == 1; });
    const bool crowded =
        std::any_of(edges.begin(), edges.end(), [&](Index e) { return triangles_at[e] > 2; });
    if (!open || !crowded) kept.triangles.push_back(skin.mesh.triangles[f]);
  }
  return kept;
}

}  // namespace bodice::anatomy
