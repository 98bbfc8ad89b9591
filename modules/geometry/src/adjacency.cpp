#include <algorithm>

#include <bodice/geometry/adjacency.hpp>

namespace bodice::geometry {
namespace {

struct HalfEdge {
  Index high, triangle, k;
};

/// Counting sort of items into buckets: returns #buckets + 1 offsets and leaves the items' slots to the
/// caller.
template <class ForEachKey>
std::vector<Index> bucket_offsets(std::size_t buckets, ForEachKey&& for_each_key) {
  std::vector<Index> offsets(buckets + 1, 0);
  for_each_key([&](Index key) { ++offsets[key + 1]; });
  for (std::size_t i = 0; i < buckets; ++i) offsets[i + 1] += offsets[i];
  return offsets;
}

void fill_vertex_triangles(const TriMesh& mesh, Adjacency& adjacency) {
  adjacency.first_of_vertex = bucket_offsets(mesh.positions.size(), [&](auto&& count) {
    for (const Triangle& t : mesh.triangles)
      for (Index v : t) count(v);
  });
  adjacency.triangle_of_vertex.resize(3 * mesh.triangles.size());
  std::vector<Index> next = adjacency.first_of_vertex;
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (Index v : mesh.triangles[t]) adjacency.triangle_of_vertex[next[v]++] = t;
}

/// Half-edges grouped by their lower vertex, with the groups' offsets.
std::vector<HalfEdge> half_edges_by_low(const TriMesh& mesh, std::vector<Index>& offsets) {
  auto for_each = [&](auto&& visit) {
    for (Index t = 0; t < mesh.triangles.size(); ++t)
      for (Index k = 0; k < 3; ++k) {
        const Index a = mesh.triangles[t][k];
        const Index b = mesh.triangles[t][(k + 1) % 3];
        if (a != b) visit(std::min(a, b), HalfEdge{std::max(a, b), t, k});
      }
  };
  offsets = bucket_offsets(mesh.positions.size(),
                           [&](auto&& count) { for_each([&](Index low, const HalfEdge&) { count(low); }); });
  std::vector<HalfEdge> sorted(offsets.back());
  std::vector<Index> next = offsets;
  for_each([&](Index low, const HalfEdge& half) { sorted[next[low]++] = half; });
  return sorted;
}

}  // namespace

Adjacency build_adjacency(const TriMesh& mesh) {
  Adjacency adjacency;
  fill_vertex_triangles(mesh, adjacency);
  adjacency.edge_of_triangle.assign(mesh.triangles.size(), {kNoIndex, kNoIndex, kNoIndex});
  adjacency.edges.reserve(mesh.triangles.size() * 3 / 2);
  std::vector<Index> offsets;
  std::vector<HalfEdge> halves = half_edges_by_low(mesh, offsets);
  for (Index low = 0; low < mesh.positions.size(); ++low) {
    const auto begin = halves.begin() + offsets[low];
    const auto end = halves.begin() + offsets[low + 1];
    std::stable_sort(begin, end, [](const HalfEdge& a, const HalfEdge& b) { return a.high < b.high; });
    for (auto half = begin; half != end; ++half) {
      if (half == begin || half->high != (half - 1)->high) adjacency.edges.push_back({{low, half->high}});
      Edge& edge = adjacency.edges.back();
      if (edge.triangle_count < 2) edge.triangle[edge.triangle_count] = half->triangle;
      ++edge.triangle_count;
      adjacency.edge_of_triangle[half->triangle][half->k] = static_cast<Index>(adjacency.edges.size() - 1);
    }
  }
  return adjacency;
}

std::vector<std::vector<Index>> boundary_loops(const TriMesh& mesh, const Adjacency& adjacency) {
  // Directed rim edges (from, to), sorted by `from`, taken one at a time.
  std::vector<std::array<Index, 2>> rim;
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Index e = adjacency.edge_of_triangle[t][k];
      if (e != kNoIndex && adjacency.edges[e].boundary())
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

int euler_characteristic(const TriMesh& mesh, const Adjacency& adjacency) {
  std::ptrdiff_t used = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    used += adjacency.first_of_vertex[v + 1] > adjacency.first_of_vertex[v];
  return static_cast<int>(used - static_cast<std::ptrdiff_t>(adjacency.edges.size()) +
                          static_cast<std::ptrdiff_t>(mesh.triangles.size()));
}

}  // namespace bodice::geometry
