// Which edges a skin has and which triangles meet at each: what graphs and isolines are built from.
#pragma once

#include <array>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::geodesic {

/// The undirected edges of a mesh, sorted by their lower, then by their higher end.
struct MeshEdges {
  using Ends = std::array<geometry::Index, 2>;

  std::vector<Ends> ends;                                   ///< #E, lower vertex first
  std::vector<std::array<geometry::Index, 2>> triangles;    ///< #E; kNoIndex where there is none (a boundary)
  std::vector<std::array<geometry::Index, 3>> of_triangle;  ///< #F; edge k joins corners k and k + 1
  std::size_t boundary = 0;                                 ///< edges with one triangle
  std::size_t non_manifold = 0;  ///< edges with three or more; only their first two are in `triangles`
};

/// O(#V + #F). Precondition: every index of a triangle is below #V.
MeshEdges mesh_edges(const geometry::TriMesh& mesh);

/// The edges at each vertex, in compressed rows: those of v are edge[offset[v]] .. edge[offset[v + 1]).
struct EdgesOfVertex {
  std::vector<geometry::Index> offset, edge;
};

/// O(#V + #E).
EdgesOfVertex edges_of_vertex(std::size_t vertices, const MeshEdges& edges);

}  // namespace bodice::geodesic
