// The textbook method: what the bucket queue is measured against.
#pragma once

#include <bodice/geodesic/distance.hpp>

namespace bodice::geodesic {

/// The same bits as distances(), by a binary heap: O(#links log #V), some three times the time
/// (bench/geodesic prints both). Not for use elsewhere.
Field distances_by_heap(const EdgeGraph& graph, std::span<const Seed> seeds);

}  // namespace bodice::geodesic
