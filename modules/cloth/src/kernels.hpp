// The inner loops over packs of constraints, for the best instruction set at hand: AVX2, or what every
// machine of its kind has.
#pragma once

#include <span>

#include "bend.hpp"
#include "stretch.hpp"

namespace bodice::cloth {

/// Packs [begin, end) of a schedule.
struct PackRange {
  std::size_t begin = 0, end = 0;
};

/// `inverse_h2` is sweeps a substep over its length squared.
void solve_stretch_packs(const StretchConstraints& constraints, PackRange packs, float inverse_h2, Point* p);
void solve_bend_packs(BendConstraints& constraints, PackRange packs, float inverse_h2, Point* p);

/// Also writes the strain of each slot (0 of idle ones).
Strain measure_stretch_packs(const StretchConstraints& constraints, PackRange packs, const Point* p,
                             std::span<float> strain);
/// Joules, that of what friction holds included.
double bend_energy_packs(const BendConstraints& constraints, PackRange packs, const Point* p);

}  // namespace bodice::cloth
