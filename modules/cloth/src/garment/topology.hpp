// The edges of a welded garment and the hinges across them, which constraints are made from.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::cloth {

using geometry::Index;

/// An edge between two particles.
struct Edge {
  Index a = 0, b = 0;     ///< a < b
  double area_m2 = 0.0;   ///< area of all its triangles
  bool diagonal = false;  ///< whether it is the diagonal of a quad, which resists shear in place of stretch
};

/// Two triangles (a, b, c) and (a, b, d) that share the edge (a, b).
struct Hinge {
  Index a = 0, b = 0, c = 0, d = 0;
};

/// All edges and hinges of a garment.
struct Topology {
  std::vector<Edge> edges;    ///< sorted by (a, b)
  std::vector<Hinge> hinges;  ///< in the order of their edges; k - 1 for an edge with k triangles
};

/// The particles that edges join to each particle, in compressed rows.
struct Ring {
  std::vector<Index> begin;  ///< #P + 1, offsets into neighbor
  std::vector<Index> neighbor;

  std::span<const Index> of(std::size_t i) const {
    return {neighbor.data() + begin[i], neighbor.data() + begin[i + 1]};
  }
};

/// The neighbors of all particles.
Ring make_ring(const geometry::TriMesh& mesh, const Topology& topology);

/// Finds edges and hinges; the winding of the triangles does not matter. O(n log n).
Topology find_topology(const geometry::TriMesh& mesh);

}  // namespace bodice::cloth
