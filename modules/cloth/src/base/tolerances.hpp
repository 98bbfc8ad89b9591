// Tolerances that keep divisions finite, and the sizes of tasks.
#pragma once

#include <cstddef>

namespace bodice::inline v0_1::cloth {

/// Square meters, added under a root: a collapsed edge has a length above zero to divide by.
inline constexpr float kTinyLength2 = 1e-24f;
/// Inverse kilograms, added to weights: a constraint between pinned particles has a weight above zero to
/// divide by.
inline constexpr float kTinyWeight = 1e-12f;
/// The speed at which cloth that was inside the body before its last step is moved out, meters a second. A
/// garment that begins two centimeters inside is out after a frame, without a jerk for neighboring particles.
inline constexpr float kFromBody_m_s = 1.0f;

/// Bounds how a distance to the body falls with travel: by at most slope times the travel, plus rise_m.
struct Steepness {
  float slope, rise_m;
};
inline constexpr Steepness kPlainSteepness = {1.0f, 0.0f};
/// Tables of relief are steep at some points. On five made bodies (seeds 0, 3, 5, 7 and 11, three poses), 1.4
/// million paths of 0.5 to 40 mm toward the surface lowered the distance by at most 2.3 mm more than twice
/// their length.
inline constexpr Steepness kReliefSteepness = {2.0f, 3e-3f};

/// The steepness that proofs assume with relief. On the same bodies, of 2 million paths of 0.25 to 8 mm that
/// end within 0.5 mm of the surface, 99.9 % fell by less than 1.4 times their length over all. On one body,
/// over paths of 0.5 to 2 mm, that was 1.6 to 1.9. The most was 5 mm more than the length.
inline constexpr Steepness kCertifiedRelief = {1.5f, 0.0f};

/// Particles a task, in loops without gathers.
inline constexpr std::size_t kParticleGrain = 1024;

/// Elements that a task of a reduction takes, so that it makes no more tasks than ordered_reduce() takes
/// without allocating.
inline constexpr std::size_t reduce_grain(std::size_t count) {
  return count / 64 + 1 > kParticleGrain ? count / 64 + 1 : kParticleGrain;
}

/// Blocks of particles that a task of a reduction takes, so that it makes no more tasks than ordered_reduce()
/// takes without allocating.
inline constexpr std::size_t few_blocks(std::size_t count) {
  return count / 64 + 1;
}

}  // namespace bodice::cloth
