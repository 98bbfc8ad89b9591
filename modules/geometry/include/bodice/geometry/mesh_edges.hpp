// The edges of a triangle mesh and the triangles that meet at each.
#pragma once

#include <array>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// The undirected edges of a mesh, sorted by their lower, then by their higher end. A triangle that names a
/// vertex twice has an edge from this vertex to itself, a loop.
struct MeshEdges {
  using Ends = std::array<Index, 2>;

  std::vector<Ends> ends;                         ///< #E, lower vertex first
  std::vector<std::array<Index, 2>> triangles;    ///< #E: the two lowest-numbered; kNoIndex at a boundary
  std::vector<Index> triangle_count;              ///< #E; 1 boundary, 2 manifold, more: non-manifold
  std::vector<std::array<Index, 3>> of_triangle;  ///< #F; edge k joins corners k and k + 1
  std::size_t boundary = 0;                       ///< edges with one triangle, loops included
  std::size_t non_manifold = 0;                   ///< edges with three or more triangles, loops included

  bool is_loop(Index edge) const { return ends[edge][0] == ends[edge][1]; }
  /// Whether exactly two triangles meet at the edge, and it is no loop.
  bool joins_two(Index edge) const { return triangle_count[edge] == 2 && !is_loop(edge); }
  /// The triangle on the other side of a triangle's edge k, or kNoIndex where joins_two() does not hold.
  Index across(Index triangle, int k) const {
    const Index e = of_triangle[triangle][k];
    if (!joins_two(e)) return kNoIndex;
    return triangles[e][0] == triangle ? triangles[e][1] : triangles[e][0];
  }
};

/// The edges of a mesh. O(#V + #F). Precondition: every index of a triangle is below #V.
MeshEdges mesh_edges(const TriMesh& mesh);

/// The edges at each vertex, in compressed rows: those of v are edge[offset[v]] .. edge[offset[v + 1]).
struct EdgesOfVertex {
  std::vector<Index> offset;  ///< #V + 1
  std::vector<Index> edge;    ///< ascending within a vertex; a loop occurs twice
};

/// The edges at each of `vertices` vertices. O(#V + #E).
EdgesOfVertex edges_of_vertex(std::size_t vertices, const MeshEdges& edges);

/// The rims of holes: chains of boundary edges along their triangles' winding. A chain begins at its smallest
/// vertex and, where the rim is clean, is closed (its first vertex is not repeated). Rims that touch in a
/// vertex part there. O(#F + #E log #E).
std::vector<std::vector<Index>> boundary_loops(const TriMesh& mesh, const MeshEdges& edges);

/// The Euler characteristic #V - #E + #F over the vertices that a triangle uses, without loops. It is 2 for
/// each closed component of genus 0.
int euler_characteristic(const TriMesh& mesh, const MeshEdges& edges);

}  // namespace bodice::geometry
