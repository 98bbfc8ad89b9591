// Pins: particles with positions that the host sets.
#pragma once

#include <span>
#include <vector>

#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// The pins of a garment.
struct Pins {
  std::vector<Index> particle;  ///< #pins: the particle of each; kNoIndex: it was dropped
  std::vector<Vec3> to;         ///< #pins: the position at the end of the frame, world meters
};

/// Sets targets; false if none is new.
bool set_pin_targets(std::span<const Vec3> world_positions, Pins& pins);

/// Gives each pin the velocity with which it reaches its target in `time_s`.
void aim_pins(const Pins& pins, double time_s, Particles& particles);

/// Puts the pins on their targets at the end of a frame, without rounding of the substeps.
void put_pins_on_targets(const Pins& pins, Particles& particles);

}  // namespace bodice::cloth
