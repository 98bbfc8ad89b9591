#include <algorithm>

#include <bodice/geometry/disjoint_sets.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::geometry {

Components connected_components(const TriMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  DisjointSets sets(count);
  for (const Triangle& t : mesh.triangles) {
    sets.unite(t[0], t[1]);
    sets.unite(t[1], t[2]);
  }
  std::vector<double> area_of_root(count, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area_of_root[sets.find(mesh.triangles[t][0])] += 0.5 * area_vector(mesh, t).norm();

  std::vector<Index> roots;
  for (Index v = 0; v < count; ++v)
    if (sets.find(v) == v) roots.push_back(v);
  std::stable_sort(roots.begin(), roots.end(),
                   [&](Index i, Index j) { return area_of_root[i] > area_of_root[j]; });

  Components result;
  std::vector<Index> rank(count, kNoIndex);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    rank[roots[i]] = static_cast<Index>(i);
    result.area.push_back(area_of_root[roots[i]]);
  }
  result.of_vertex.resize(count);
  for (Index v = 0; v < count; ++v) result.of_vertex[v] = rank[sets.find(v)];
  return result;
}

TriMesh largest_components(const TriMesh& mesh, const Components& components, std::size_t count) {
  TriMesh kept;
  std::vector<Index> number(mesh.positions.size(), kNoIndex);
  for (const Triangle& t : mesh.triangles) {
    if (components.of_vertex[t[0]] >= count) continue;
    Triangle& out = kept.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      Index& n = number[t[k]];
      if (n == kNoIndex) {
        n = static_cast<Index>(kept.positions.size());
        kept.positions.push_back(mesh.positions[t[k]]);
      }
      out[k] = n;
    }
  }
  return kept;
}

}  // namespace bodice::geometry
