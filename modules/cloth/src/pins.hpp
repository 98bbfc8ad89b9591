// Vertices that the host holds.
#pragma once

#include <span>
#include <vector>

#include "particles.hpp"

namespace bodice::cloth {

struct Pins {
  std::vector<Index> particle;  ///< one a pin of make(); kNoIndex: dropped
  std::vector<Vec3> from;       ///< world metres, at the start of the frame
  std::vector<Vec3> to;         ///< world metres, at its end
};

void set_pin_targets(std::span<const Vec3> world_positions, Pins& pins);

/// Puts the pins at the share t of their way; after it old_* stays, so that contacts see their path.
void move_pins(const Pins& pins, double t, Particles& particles);

/// The frame is over: the pins rest where they are.
void settle_pins(Pins& pins);

}  // namespace bodice::cloth
