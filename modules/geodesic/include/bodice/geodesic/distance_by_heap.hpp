// Dijkstra's method with a binary heap, as a reference for tests and bench/geodesic.
#pragma once

#include <bodice/geodesic/distance.hpp>

namespace bodice::inline v0_1::geodesic {

/// The same bits as distances(), by a binary heap. Cost: O(#links log #V), about three times that of
/// distances().
Field distances_by_heap(const EdgeGraph& graph, std::span<const Seed> seeds);

}  // namespace bodice::geodesic
