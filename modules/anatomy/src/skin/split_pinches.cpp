#include "skin/split_pinches.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Index;
using geometry::kNoIndex;

/// The corners of all triangles, joined where triangles share an edge; path-halving union-find.
class Fans {
 public:
  Fans(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges)
      : mesh_(mesh), root_(3 * mesh.triangles.size()) {
    for (std::size_t c = 0; c < root_.size(); ++c) root_[c] = static_cast<Index>(c);
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      const auto [f, g] = edges.triangles[e];
      if (g == kNoIndex) continue;
      for (const Index v : edges.ends[e]) join(corner_of(f, v), corner_of(g, v));
    }
  }
  Index of(Index corner) {
    while (root_[corner] != corner) corner = root_[corner] = root_[root_[corner]];
    return corner;
  }

 private:
  Index corner_of(Index triangle, Index vertex) const {
    const auto& t = mesh_.triangles[triangle];
    return 3 * triangle + (t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
  }
  void join(Index a, Index b) {
    a = of(a);
    b = of(b);
    if (a != b) root_[std::max(a, b)] = std::min(a, b);
  }
  const geometry::TriMesh& mesh_;
  std::vector<Index> root_;
};

}  // namespace

SplitSkin split_pinches(const Skin& skin) {
  const geometry::TriMesh& mesh = skin.mesh;
  SplitSkin split{mesh, {}};
  if (skin.edges.non_manifold > 0) return split;
  Fans fans(mesh, skin.edges);
  std::vector<Index> first(mesh.positions.size(), kNoIndex);  // fan that keeps the vertex
  std::vector<Index> copy(3 * mesh.triangles.size(), kNoIndex);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Index v = mesh.triangles[f][k], fan = fans.of(static_cast<Index>(3 * f + k));
      if (first[v] == kNoIndex) first[v] = fan;
      if (first[v] == fan) continue;
      if (copy[fan] == kNoIndex) {
        copy[fan] = static_cast<Index>(split.mesh.positions.size());
        split.mesh.positions.push_back(mesh.positions[v]);
        split.origin.push_back(v);
      }
      split.mesh.triangles[f][k] = copy[fan];
    }
  return split;
}

bool surely_unpinched(const Skin& skin) {
  return skin.edges.boundary == 0 && skin.edges.non_manifold == 0 &&
         skin.mesh.positions.size() + skin.mesh.triangles.size() ==
             skin.edges.ends.size() + 2 * skin.components;
}

}  // namespace bodice::anatomy
