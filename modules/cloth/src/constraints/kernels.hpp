// The inner loops over packs of constraints, for the best instruction set at hand: AVX2, or what every
// machine of its kind has.
#pragma once

#include <span>

#include "constraints/bend.hpp"
#include "constraints/stretch.hpp"

namespace bodice::cloth {

/// Edges and hinges inside a block name the points of its patch, `p`; those across name all points. `longest`
/// is the length allowed in rest lengths, `inverse_h2` is sweeps a substep over its length squared.
void solve_packs(std::span<const EdgePack<Local>> packs, float longest, float inverse_h2, Point* p);
void solve_packs(std::span<const EdgePack<Index>> packs, float longest, float inverse_h2, Point* p);
void solve_packs(std::span<HingePack<Local>> packs, const YarnFriction& yarn, float inverse_h2, Point* p);
void solve_packs(std::span<HingePack<Index>> packs, const YarnFriction& yarn, float inverse_h2, Point* p);

/// Also writes the strain of each slot (0 of idle ones).
Strain measure_packs(std::span<const EdgePack<Local>> packs, const Point* p, float* strain);
Strain measure_packs(std::span<const EdgePack<Index>> packs, const Point* p, float* strain);
/// Joules, that of what friction holds included.
double energy_of_packs(std::span<const HingePack<Local>> packs, const YarnFriction& yarn, const Point* p);
double energy_of_packs(std::span<const HingePack<Index>> packs, const YarnFriction& yarn, const Point* p);

}  // namespace bodice::cloth
