// The inner loops over packs of constraints, for the best instruction set of the machine: AVX2 or the
// baseline.
#pragma once

#include <span>

#include "constraints/bend.hpp"
#include "constraints/stretch.hpp"

namespace bodice::inline v0_1::cloth {

/// Solve packs of constraints in place. `p` is the patch of a block, for packs inside it, or all points.
/// `longest` is the allowed length in rest lengths, `inverse_h2` the number of sweeps in a substep over the
/// square of its length.
void solve_packs(std::span<const EdgePack<Local>> packs, float longest, float inverse_h2, Point* p);
void solve_packs(std::span<const EdgePack<Index>> packs, float longest, float inverse_h2, Point* p);
void solve_packs(std::span<HingePack<Local>> packs, const YarnFriction& yarn, float inverse_h2, Point* p);
void solve_packs(std::span<HingePack<Index>> packs, const YarnFriction& yarn, float inverse_h2, Point* p);

/// Measure packs of edges, and write the strain of each slot (0 for idle ones).
Strain measure_packs(std::span<const EdgePack<Local>> packs, const Point* p, float* strain);
Strain measure_packs(std::span<const EdgePack<Index>> packs, const Point* p, float* strain);
/// The potential energy of packs of hinges, joules, with that of the springs of friction.
double energy_of_packs(std::span<const HingePack<Local>> packs, const YarnFriction& yarn, const Point* p);
double energy_of_packs(std::span<const HingePack<Index>> packs, const YarnFriction& yarn, const Point* p);

}  // namespace bodice::cloth
