#include <bodice/geometry/split_pinches.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

namespace bodice::inline v0_1::geometry {
namespace {

/// The edge of a triangle opposite to a vertex, in the direction of its winding.
struct LinkEdge {
  Index from = 0, to = 0;
  std::size_t triangle = 0;
};

/// The ends of edges that more than two triangles share, each once, in increasing order.
std::vector<Index> ends_of_pinches(const TriMesh& mesh) {
  std::vector<std::uint64_t> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      edges.push_back(std::uint64_t{low} << 32 | high);
    }
  std::ranges::sort(edges);
  std::vector<Index> ends;
  for (std::size_t i = 2; i < edges.size(); ++i)
    if (edges[i] == edges[i - 2])
      ends.push_back(static_cast<Index>(edges[i] >> 32)), ends.push_back(static_cast<Index>(edges[i]));
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// Cuts the walks around a vertex where they meet a neighbor again: each piece is a fan of triangles, in
/// which every neighbor occurs once.
std::vector<std::vector<LinkEdge>> fans_of(std::vector<LinkEdge> link) {
  std::vector<std::vector<LinkEdge>> fans;
  while (!link.empty()) {
    std::vector<LinkEdge> walk{link.front()};
    link.erase(link.begin());
    for (;;) {
      const auto again = std::ranges::find(walk, walk.back().to, &LinkEdge::from);
      if (again != walk.end()) {
        fans.emplace_back(again, walk.end());
        walk.erase(again, walk.end());
        if (walk.empty()) break;
        continue;
      }
      const auto next = std::ranges::find(link, walk.back().to, &LinkEdge::from);
      if (next == link.end()) {  // an open mesh: its border ends the fan
        fans.push_back(std::move(walk));
        break;
      }
      walk.push_back(*next);
      link.erase(next);
    }
  }
  return fans;
}

}  // namespace

std::vector<Index> split_pinches(TriMesh& mesh, double share) {
  const std::vector<Index> ends = ends_of_pinches(mesh);
  std::vector<Index> original;
  if (ends.empty()) return original;
  std::map<Index, std::vector<std::size_t>> around;
  for (const Index end : ends) around[end];
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index v : mesh.triangles[t])
      if (const auto found = around.find(v); found != around.end()) found->second.push_back(t);
  for (const auto& [vertex, triangles] : around) {
    std::vector<LinkEdge> link;
    for (const std::size_t t : triangles) {
      const Triangle& corners = mesh.triangles[t];
      const auto k = static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
      link.push_back({corners[(k + 1) % 3], corners[(k + 2) % 3], t});
    }
    const std::vector<std::vector<LinkEdge>> fans = fans_of(std::move(link));
    if (fans.size() < 2) continue;
    const Vec3 center = mesh.positions[vertex];
    for (std::size_t f = 0; f < fans.size(); ++f) {
      Index copy = vertex;
      if (f > 0) {
        copy = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(center), original.push_back(vertex);
      }
      Vec3 mean = Vec3::Zero();
      for (const LinkEdge& edge : fans[f])
        mean += mesh.positions[edge.from] / static_cast<double>(fans[f].size());
      mesh.positions[copy] = center + share * (mean - center);
      for (const LinkEdge& edge : fans[f])
        for (Index& corner : mesh.triangles[edge.triangle])
          if (corner == vertex) corner = copy;
    }
  }
  return original;
}

}  // namespace bodice::geometry
