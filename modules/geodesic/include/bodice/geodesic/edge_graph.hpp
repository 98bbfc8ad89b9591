// The skin as a weighted graph in compressed rows, on which Dijkstra's method runs.
#pragma once

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_edges.hpp>

namespace bodice::inline v0_1::geodesic {

/// The paths across the skin that a graph allows.
enum class Metric {
  kEdges,     ///< along mesh edges, as in the paper: about 4 % too long, and finer meshes do not help
  kUnfolded,  ///< also straight across each pair of triangles laid flat about their edge: under 2 % too long
};

/// One directed link of a graph.
struct Link {
  geometry::Index to = 0;
  float length = 0.0F;  ///< meters, > 0
};

/// A weighted graph. The links of vertex v are links[offset[v]] .. links[offset[v + 1]).
struct EdgeGraph {
  std::vector<geometry::Index> offset;  ///< #V + 1
  std::vector<Link> links;
  float longest = 0.0F;  ///< meters
  float mean = 0.0F;     ///< meters

  std::size_t vertex_count() const { return offset.empty() ? 0 : offset.size() - 1; }
};

/// The graph of a mesh. Lengths that are zero or not finite are raised to a millionth of the mean edge, so
/// that every path has a length. O(#V + #F).
EdgeGraph edge_graph(const engine::Context& context, const geometry::TriMesh& mesh,
                     const geometry::MeshEdges& edges, Metric metric);

/// A link in both directions between two vertices, for instance across the gap between two pieces of one
/// body.
struct Bridge {
  geometry::Index from = 0, to = 0;
  float length = 0.0F;
};
/// A graph with these links besides its own. Where two vertices have several, all count. O(#links).
EdgeGraph with_bridges(const EdgeGraph& graph, const std::vector<Bridge>& bridges);

}  // namespace bodice::geodesic
