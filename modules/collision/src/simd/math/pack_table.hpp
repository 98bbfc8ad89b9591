// Which lanes close up to which, for every mask of eight lanes.
#pragma once

#include <cstdint>

namespace bodice::collision {

inline constexpr int kPackLanes = 8;

struct PackTable {
  /// Of a mask's bits: the lanes that are set, rising, then zeros. Of four lanes the same, in the first four.
  std::uint8_t from[1 << kPackLanes][kPackLanes] = {};

  constexpr PackTable() {
    for (int mask = 0; mask < 1 << kPackLanes; ++mask)
      for (int lane = 0, to = 0; lane < kPackLanes; ++lane)
        if ((mask >> lane & 1) != 0) from[mask][to++] = static_cast<std::uint8_t>(lane);
  }
};
inline constexpr PackTable kPackTable;

}  // namespace bodice::collision
