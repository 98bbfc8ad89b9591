// Vertices that the host holds.
#pragma once

#include <span>
#include <vector>

#include "base/particles.hpp"

namespace bodice::cloth {

struct Pins {
  std::vector<Index> particle;  ///< one a pin of make(); kNoIndex: dropped
  std::vector<Vec3> to;         ///< world meters, at the end of the frame
};

/// Whether any target is new.
bool set_pin_targets(std::span<const Vec3> world_positions, Pins& pins);

/// Gives each pin the velocity that takes it to its target in `time_s`.
void aim_pins(const Pins& pins, double time_s, Particles& particles);

/// The frame is over: the pins are where they were to be, free of rounding.
void settle_pins(const Pins& pins, Particles& particles);

}  // namespace bodice::cloth
