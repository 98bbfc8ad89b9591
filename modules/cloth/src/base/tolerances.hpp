// What keeps divisions by nothing finite, and the size of tasks.
#pragma once

#include <cstddef>

namespace bodice::cloth {

/// Square meters under a root: the length of a collapsed edge, so that it divides nothing by zero.
inline constexpr float kTinyLength2 = 1e-24f;
/// Inverse kilograms: a constraint between pinned particles divides nothing by zero.
inline constexpr float kTinyWeight = 1e-12f;
/// Particles a task in loops without gathers.
inline constexpr std::size_t kParticleGrain = 1024;

/// Elements a task where each gives a number: never more blocks than an ordered_reduce takes unallocated.
inline constexpr std::size_t reduce_grain(std::size_t count) {
  return count / 64 + 1 > kParticleGrain ? count / 64 + 1 : kParticleGrain;
}

/// Blocks of particles a task, likewise.
inline constexpr std::size_t few_blocks(std::size_t count) {
  return count / 64 + 1;
}

}  // namespace bodice::cloth
