// Who is next to whom in a triangle mesh.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::geometry {

/// An undirected edge with the first two triangles on it, in order of their number.
struct Edge {
  std::array<Index, 2> vertex = {kNoIndex, kNoIndex};    ///< vertex[0] < vertex[1]
  std::array<Index, 2> triangle = {kNoIndex, kNoIndex};  ///< triangle[1] is kNoIndex on a boundary
  Index triangle_count = 0;                              ///< 1 boundary, 2 manifold, more: non-manifold

  bool boundary() const { return triangle_count == 1; }
  bool manifold() const { return triangle_count <= 2; }
};

struct Adjacency {
  std::vector<Edge> edges;                             ///< sorted by (vertex[0], vertex[1])
  std::vector<std::array<Index, 3>> edge_of_triangle;  ///< #F: edge k joins corners k and k + 1;
                                                       ///< kNoIndex where both are the same vertex
  std::vector<Index> first_of_vertex;                  ///< #V + 1 offsets into triangle_of_vertex
  std::vector<Index> triangle_of_vertex;               ///< ascending within a vertex

  std::span<const Index> triangles_around(Index vertex) const {
    return {triangle_of_vertex.data() + first_of_vertex[vertex],
            first_of_vertex[vertex + 1] - first_of_vertex[vertex]};
  }
  /// The triangle on the other side of edge k, or kNoIndex at a boundary or a non-manifold edge.
  Index across(Index triangle, int k) const {
    const Index e = edge_of_triangle[triangle][k];
    if (e == kNoIndex || edges[e].triangle_count != 2) return kNoIndex;
    return edges[e].triangle[0] == triangle ? edges[e].triangle[1] : edges[e].triangle[0];
  }
};

/// O(#V + #F) for bounded valence. Precondition: every index is below #V.
Adjacency build_adjacency(const TriMesh& mesh);

/// The holes' rims: chains of boundary edges along their triangles' winding, each started at its smallest
/// vertex and, where the rim is clean, closed (the first vertex is not repeated). Where rims touch in a
/// vertex they part there. O(#E).
std::vector<std::vector<Index>> boundary_loops(const TriMesh& mesh, const Adjacency& adjacency);

/// #V - #E + #F over the vertices that a triangle uses: 2 for each closed component of genus 0.
int euler_characteristic(const TriMesh& mesh, const Adjacency& adjacency);

}  // namespace bodice::geometry
