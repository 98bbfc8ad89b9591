// Distances along the cloth at rest, over edges and across unfolded pairs of triangles.
#pragma once

#include <utility>
#include <vector>

#include "garment/topology.hpp"

namespace bodice::inline v0_1::cloth {

/// Finds distances along a cloth; it keeps its memory between calls.
class ClothDistance {
 public:
  ClothDistance(const geometry::TriMesh& mesh, const Topology& topology);

  /// The k particles within `radius_m` of `from` with their distances, nearest first. O(k log k).
  const std::vector<std::pair<double, Index>>& within(Index from, double radius_m);

 private:
  std::vector<Index> begin_;
  std::vector<std::pair<Index, double>> step_;
  std::vector<double> distance_;
  std::vector<std::pair<double, Index>> heap_, found_;
};

}  // namespace bodice::cloth
