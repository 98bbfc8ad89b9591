// Counts from the triangles alone, as an oracle that shares nothing with the code that makes the meshes.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice_test {

struct MeshFacts {
  long euler = 0;  ///< vertices - edges + triangles
  long components = 0;
  long boundary_loops = 0;
  long repeated_half_edges = 0;  ///< the same directed edge twice: fins or inconsistent winding
  long boundary_edges = 0;
  long slivers = 0;            ///< triangles of quality below 0.1
  double worst_quality = 1.0;  ///< 4 sqrt(3) area over the sum of squared edges; 1 is equilateral
};

inline MeshFacts facts_of(const bodice::geometry::TriMesh& mesh) {
  using bodice::geometry::Index;
  MeshFacts facts;
  std::vector<std::size_t> root(mesh.positions.size());
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::size_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  std::map<std::array<Index, 2>, int> half_edges;
  for (const auto& t : mesh.triangles) {
    double squares = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      if (++half_edges[{a, b}] > 1) ++facts.repeated_half_edges;
      root[find(a)] = find(b);
      squares += (mesh.positions[a] - mesh.positions[b]).squaredNorm();
    }
    const auto& p = mesh.positions;
    const double area = 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
    const double quality = 6.928203230275509 * area / squares;
    facts.worst_quality = std::min(facts.worst_quality, quality);
    facts.slivers += quality < 0.1;
  }
  std::map<Index, Index> next;  // along the boundary; each loop is one component of it
  long edges = 0;
  for (const auto& [edge, count] : half_edges) {
    const bool open = half_edges.find({edge[1], edge[0]}) == half_edges.end();
    if (open || edge[0] < edge[1]) ++edges;
    if (!open) continue;
    ++facts.boundary_edges;
    next[edge[0]] = edge[1];
  }
  while (!next.empty()) {
    ++facts.boundary_loops;
    for (auto at = next.begin(); at != next.end();) {
      const Index to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  for (std::size_t v = 0; v < root.size(); ++v) facts.components += find(v) == v;
  facts.euler = static_cast<long>(mesh.positions.size()) - edges + static_cast<long>(mesh.triangles.size());
  return facts;
}

}  // namespace bodice_test
