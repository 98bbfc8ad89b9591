// One interface to three methods of measuring distance along a skin; the more exact ones cost more time.
#pragma once

#include <bodice/geodesic/distance.hpp>

namespace bodice::inline v0_1::geodesic {

/// A method. Errors are against exact polyhedral distances on a body of 13,000 vertices; bench/geodesic
/// prints them and the times.
enum class Method {
  kEdges,         ///< the paper's: Dijkstra along edges, about 4 % too long
  kUnfolded,      ///< Dijkstra with links across unfolded pairs of triangles: under 2 % too long
  kFastMarching,  ///< a front over the triangles, sources unfolded: about half a percent off
};

/// A solver for one mesh and its edges. It keeps references to both, so that both must outlive it;
/// temporaries do not compile. Const calls may run at the same time.
class DistanceSolver {
 public:
  /// Prepares what the method needs: a graph of the edges, or the edges around each vertex. O(#V + #F).
  DistanceSolver(const engine::Context& context, const geometry::TriMesh& mesh,
                 const geometry::MeshEdges& edges, Method method);
  DistanceSolver(const engine::Context&, const geometry::TriMesh&&, const geometry::MeshEdges&,
                 Method) = delete;
  DistanceSolver(const engine::Context&, const geometry::TriMesh&, const geometry::MeshEdges&&,
                 Method) = delete;
  DistanceSolver(const engine::Context&, const geometry::TriMesh&&, const geometry::MeshEdges&&,
                 Method) = delete;

  /// Distances, #V, meters; kUnreachable where no source leads. Sources outside the mesh are ignored.
  Field distances(std::span<const Seed> seeds) const;
  /// The same from one vertex.
  Field distances_from(geometry::Index source) const;

 private:
  const geometry::TriMesh& mesh_;
  const geometry::MeshEdges& edges_;
  Method method_;
  EdgeGraph graph_;                 ///< used by Dijkstra; empty for fast marching
  geometry::EdgesOfVertex around_;  ///< used by fast marching; empty for Dijkstra
};

}  // namespace bodice::geodesic
