// Union-find: which members of a set are connected.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// Disjoint sets of the numbers below `count`. The root of a set is its smallest member, so that the result
/// does not depend on the order of unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  /// The least member of the set that i is in.
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Makes one set of the two that i and j are in.
  void unite(Index i, Index j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace bodice::geometry
