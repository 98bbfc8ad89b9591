// Distances along the skin.
#pragma once

#include <span>

#include <bodice/geodesic/edge_graph.hpp>

namespace bodice::inline v0_1::geodesic {

/// The distance of a vertex that no source reaches, because it lies on another piece of the mesh.
inline constexpr float kUnreachable = std::numeric_limits<float>::infinity();

/// A source with the distance at which it starts.
struct Seed {
  geometry::Index vertex = 0;
  float distance = 0.0F;  ///< meters, >= 0
};

/// The distance of every vertex from its closest source, #V, meters.
using Field = std::vector<float>;

/// The distance of every vertex from its closest source, and which source that is.
struct NearestSource {
  Field distance;                       ///< #V
  std::vector<geometry::Index> source;  ///< #V: position in the list of sources, kNoIndex if unreachable
};

/// Distances by one run from several sources at once. Sources outside the graph are ignored. Cost: O(#links)
/// where edges are of similar length; longer where their lengths spread, by at most that spread.
Field distances(const EdgeGraph& graph, std::span<const Seed> seeds);
/// The same from one vertex.
Field distances_from(const EdgeGraph& graph, geometry::Index source);
/// Distances up to `most` meters, with the same bits; kUnreachable beyond. Cost: that of the part within.
Field distances_within(const EdgeGraph& graph, std::span<const Seed> seeds, float most);
/// Distances and the closest source of each vertex; of several at the same distance, the first in the list.
NearestSource nearest_sources(const EdgeGraph& graph, std::span<const geometry::Index> sources);

/// Distances from each source alone, one field a source, in parallel over the sources.
std::vector<Field> distances_each(const engine::Context& context, const EdgeGraph& graph,
                                  std::span<const geometry::Index> sources);

/// The vertices of a shortest path from `from` to a source of `field`; empty where none is reachable.
std::vector<geometry::Index> descend(const EdgeGraph& graph, const Field& field, geometry::Index from);

}  // namespace bodice::geodesic
