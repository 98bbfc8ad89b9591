// Pins: particles with positions that the host sets.
#pragma once

#include <span>
#include <vector>

#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// The pins of a garment.
struct Pins {
  std::vector<Index> particle;  ///< #pins: the particle of each; kNoIndex: it was dropped
  std::vector<Vec3> from, to;   ///< #pins: where its path begins and ends in this frame, world meters
  bool yield = false;           ///< SolverOptions::pins_yield
};

/// Sets targets; false if none is new.
bool set_pin_targets(std::span<const Vec3> world_positions, Pins& pins);

/// Begins the paths of a frame. Pins that yield go on along their old paths, all others from where they are.
void begin_pin_paths(const Particles& particles, Pins& pins);

/// Gives each pin the velocity with which it is on its path when the substep ends. A pin that
/// contact moved returns to its path at a limited speed. `begin` and `end` are shares of the frame.
void aim_pins(const Pins& pins, double begin, double end, double substep_s, Particles& particles);

/// Ends a frame: the targets are where the next paths begin. Pins that do not yield are put there, without
/// rounding of the substeps.
void end_pin_paths(Pins& pins, Particles& particles);

/// Makes pins that yield free for contact, which may then move them, or fixed again for constraints.
void free_yielding_pins(const Pins& pins, bool free, Particles& particles);

}  // namespace bodice::cloth
