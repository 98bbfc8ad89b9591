#include <algorithm>

#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::inline v0_1::geometry {

std::vector<std::vector<Index>> boundary_loops(const TriMesh& mesh, const MeshEdges& edges) {
  // The edges of the rims as (from, to), sorted by `from`. Each is used once.
  std::vector<std::array<Index, 2>> rim;
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index e = edges.of_triangle[t][k];
      if (edges.triangle_count[e] == 1 && !edges.is_loop(e))
        rim.push_back({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]});
    }
  std::sort(rim.begin(), rim.end());
  std::vector<bool> taken(rim.size(), false);
  auto next_from = [&](Index vertex) {
    auto at = std::lower_bound(rim.begin(), rim.end(), std::array<Index, 2>{vertex, 0});
    while (at != rim.end() && (*at)[0] == vertex && taken[at - rim.begin()]) ++at;
    return at != rim.end() && (*at)[0] == vertex ? static_cast<std::size_t>(at - rim.begin()) : rim.size();
  };
  std::vector<std::vector<Index>> loops;
  for (std::size_t start = 0; start < rim.size(); ++start) {
    if (taken[start]) continue;
    std::vector<Index>& loop = loops.emplace_back();
    for (std::size_t e = start; e < rim.size(); e = next_from(rim[e][1])) {
      taken[e] = true;
      loop.push_back(rim[e][0]);
      if (rim[e][1] == rim[start][0]) break;
    }
  }
  return loops;
}

int euler_characteristic(const TriMesh& mesh, const MeshEdges& edges) {
  std::vector<bool> is_used(mesh.positions.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) is_used[v] = true;
  std::ptrdiff_t count = std::count(is_used.begin(), is_used.end(), true);
  for (Index e = 0; e < edges.ends.size(); ++e) count -= !edges.is_loop(e);
  return static_cast<int>(count + static_cast<std::ptrdiff_t>(mesh.triangles.size()));
}

}  // namespace bodice::geometry
