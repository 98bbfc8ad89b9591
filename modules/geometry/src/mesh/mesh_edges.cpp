#include <algorithm>
#include <span>

#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

/// One side of a triangle, seen from its lower end.
struct Side {
  Index high;
  Index triangle;
  Index corner;
};

/// The three sides of every triangle, grouped by their lower end; a group starts at offset[low].
struct Sides {
  std::vector<Index> offset;
  std::vector<Side> side;
};

Sides sides_by_lower_end(const TriMesh& mesh) {
  Sides sides;
  sides.offset.assign(mesh.positions.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++sides.offset[std::min(t[k], t[(k + 1) % 3]) + 1];
  for (std::size_t v = 1; v < sides.offset.size(); ++v) sides.offset[v] += sides.offset[v - 1];
  sides.side.resize(3 * mesh.triangles.size());
  std::vector<Index> next(sides.offset.begin(), sides.offset.end() - 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[f][k], mesh.triangles[f][(k + 1) % 3]);
      sides.side[next[low]++] = {high, static_cast<Index>(f), static_cast<Index>(k)};
    }
  return sides;
}

using Run = std::span<const Side>;

/// Appends one edge, given its sides in the order of their triangles.
void add_edge(MeshEdges& edges, Index low, Run sides) {
  const auto e = static_cast<Index>(edges.ends.size());
  edges.ends.push_back({low, sides[0].high});
  edges.triangles.push_back({sides[0].triangle, sides.size() > 1 ? sides[1].triangle : kNoIndex});
  for (const Side& side : sides) edges.of_triangle[side.triangle][side.corner] = e;
  edges.triangle_count.push_back(static_cast<Index>(sides.size()));
  edges.boundary += sides.size() == 1;
  edges.non_manifold += sides.size() > 2;
}

}  // namespace

MeshEdges mesh_edges(const TriMesh& mesh) {
  Sides sides = sides_by_lower_end(mesh);
  MeshEdges edges;
  edges.of_triangle.resize(mesh.triangles.size());
  edges.ends.reserve(mesh.triangles.size() * 3 / 2 + 1);
  edges.triangles.reserve(edges.ends.capacity());
  edges.triangle_count.reserve(edges.ends.capacity());
  for (std::size_t low = 0; low < mesh.positions.size(); ++low) {
    const auto begin = sides.side.begin() + sides.offset[low],
               end = sides.side.begin() + sides.offset[low + 1];
    std::sort(begin, end, [](const Side& a, const Side& b) {
      return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
    });
    for (auto run = begin; run != end;) {
      const auto stop = std::find_if(run, end, [&](const Side& side) { return side.high != run->high; });
      add_edge(edges, static_cast<Index>(low), Run(&*run, static_cast<std::size_t>(stop - run)));
      run = stop;
    }
  }
  return edges;
}

EdgesOfVertex edges_of_vertex(std::size_t vertices, const MeshEdges& edges) {
  EdgesOfVertex around;
  around.offset.assign(vertices + 1, 0);
  for (const auto& ends : edges.ends)
    for (const Index v : ends) ++around.offset[v + 1];
  for (std::size_t v = 1; v <= vertices; ++v) around.offset[v] += around.offset[v - 1];
  around.edge.resize(2 * edges.ends.size());
  std::vector<Index> next(around.offset.begin(), around.offset.end() - 1);
  for (std::size_t e = 0; e < edges.ends.size(); ++e)
    for (const Index v : edges.ends[e]) around.edge[next[v]++] = static_cast<Index>(e);
  return around;
}

}  // namespace bodice::geometry
