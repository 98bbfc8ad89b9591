// Distances along the skin.
#pragma once

#include <span>

#include <bodice/geodesic/edge_graph.hpp>

namespace bodice::geodesic {

/// Distance of a vertex that no source reaches (another piece of the mesh).
inline constexpr float kUnreachable = std::numeric_limits<float>::infinity();

/// A source and the distance it starts with.
struct Seed {
  geometry::Index vertex = 0;
  float distance = 0.0F;  ///< meters, >= 0
};

/// Distance of every vertex from its nearest source, #V, meters.
using Field = std::vector<float>;

struct NearestSource {
  Field distance;                       ///< #V
  std::vector<geometry::Index> source;  ///< #V: position in the list of sources, kNoIndex if unreachable
};

/// One run from several sources at once. Sources outside the graph are ignored. O(#links) for meshes whose
/// edges are of similar length, O(#links log #V) at worst is not exceeded by more than the spread of lengths.
Field distances(const EdgeGraph& graph, std::span<const Seed> seeds);
Field distances_from(const EdgeGraph& graph, geometry::Index source);
/// The same where that is at most `most` meters; kUnreachable farther off. Costs what lies within.
Field distances_within(const EdgeGraph& graph, std::span<const Seed> seeds, float most);
/// The same, and which source is nearest; the first in the list among equals.
NearestSource nearest_sources(const EdgeGraph& graph, std::span<const geometry::Index> sources);

/// One field a source, in parallel over the sources.
std::vector<Field> distances_each(const engine::Context& context, const EdgeGraph& graph,
                                  std::span<const geometry::Index> sources);

/// The vertices of a shortest path from `from` down to a source of `field`; empty if unreachable.
std::vector<geometry::Index> descend(const EdgeGraph& graph, const Field& field, geometry::Index from);

}  // namespace bodice::geodesic
