// Tolerances that keep divisions finite, and the sizes of tasks.
#pragma once

#include <cstddef>

namespace bodice::cloth {

/// Square meters, added under a root: a collapsed edge has a length above zero to divide by.
inline constexpr float kTinyLength2 = 1e-24f;
/// Inverse kilograms, added to weights: a constraint between pinned particles has a weight above zero to
/// divide by.
inline constexpr float kTinyWeight = 1e-12f;
/// Particles a task, in loops without gathers.
inline constexpr std::size_t kParticleGrain = 1024;

/// Elements a task in a reduction: it makes no more tasks than ordered_reduce() takes without allocating.
inline constexpr std::size_t reduce_grain(std::size_t count) {
  return count / 64 + 1 > kParticleGrain ? count / 64 + 1 : kParticleGrain;
}

/// Blocks of particles a task in a reduction, for the same reason.
inline constexpr std::size_t few_blocks(std::size_t count) {
  return count / 64 + 1;
}

}  // namespace bodice::cloth
