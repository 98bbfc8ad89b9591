// Permutation that moves the chosen lanes to the front, for every mask of eight lanes.
#pragma once

#include <cstdint>

namespace bodice::inline v0_1::collision {

inline constexpr int kPackLanes = 8;

/// The table of all masks, computed at compile time.
struct PackTable {
  /// For each mask the indices of its lanes, rising, then zeros. Masks of four lanes use the first four
  /// entries.
  std::uint8_t from[1 << kPackLanes][kPackLanes] = {};

  constexpr PackTable() {
    for (int mask = 0; mask < 1 << kPackLanes; ++mask)
      for (int lane = 0, to = 0; lane < kPackLanes; ++lane)
        if ((mask >> lane & 1) != 0) from[mask][to++] = static_cast<std::uint8_t>(lane);
  }
};
inline constexpr PackTable kPackTable;

}  // namespace bodice::collision
