// The grid of octahedral nodes as a closed surface: nodes of the same direction share an unknown, and steps
// across the border lead to its other side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bodice::inline v0_1::fitting {

/// The unknowns of a table.
struct ReliefGrid {
  int n = 0;                              ///< nodes along a side
  int unknowns = 0;                       ///< number of distinct directions
  std::vector<std::uint32_t> unknown_of;  ///< n x n: border nodes have the unknown of their mirror
  std::vector<std::array<std::uint32_t, 3>>
      second;  ///< (before, node, after) along rows and columns, as unknowns
};

/// The grid with n nodes along a side, n >= 2. O(n^2).
ReliefGrid make_relief_grid(int n);

}  // namespace bodice::fitting
