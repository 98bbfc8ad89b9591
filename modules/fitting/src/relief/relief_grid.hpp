// The octahedral node grid as a closed surface: which nodes are the same direction, and who neighbors whom.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bodice::fitting {

struct ReliefGrid {
  int n = 0;                                         ///< nodes per side
  int unknowns = 0;                                  ///< distinct directions
  std::vector<std::uint32_t> unknown_of;             ///< #n*n: border nodes share theirs with their mirrors
  std::vector<std::array<std::uint32_t, 3>> second;  ///< triples (before, node, after) along rows and columns
};

/// n >= 2. O(n^2).
ReliefGrid make_relief_grid(int n);

}  // namespace bodice::fitting
