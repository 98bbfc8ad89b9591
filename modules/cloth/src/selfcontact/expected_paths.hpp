// The paths on which a search expects particles to move. How far particles deviate from them decides when the
// next search is due.
#pragma once

#include "selfcontact/self_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// The expected positions of particles at a time after the last search, and their allowed deviations.
struct Expectation {
  const SelfContact& self;
  float share, most_m;

  /// The expectation `since_s` after the search. A particle may deviate by `most_m` plus its own allowance,
  /// ExpectedPaths::allowance_m.
  Expectation(float since_s, float most_m, const SelfContact& self);

  /// The squared deviation of particle i at `at`, square meters.
  float deviation2(std::span<const Point> at, std::size_t i) const {
    const Float4 off = xyz(load(at[i]) - load(self.paths.start[i]) - share * load(self.paths.move[i]));
    return dot(off, off);
  }
  /// Whether particle i may deviate by this squared distance.
  bool allows(float deviation2, std::size_t i) const {
    const float allowed_m = most_m + self.paths.allowance_m[i];
    return deviation2 <= allowed_m * allowed_m;
  }
};

/// Stores the deviations of the particles at `at`, `since_s` after the search, in ExpectedPaths::deviation2.
/// Returns whether any exceeds what Expectation allows.
bool measure_deviations(const engine::Context& context, std::span<const Point> at, float since_s,
                        float most_m, SelfContact& self);

/// The same for the particles of some leaves alone, on the calling thread.
bool measure_deviations_of(std::span<const std::uint32_t> leaves, std::span<const Point> at, float since_s,
                           float most_m, SelfContact& self);

/// The largest deviation of a leaf's particles, meters.
float largest_deviation(std::size_t leaf, const SelfContact& self);

/// Sets the expected paths of the next frame: particles go on with their smoothed velocities. Where a
/// particle at `at` already deviates from that by more than `most_m`, its path is corrected until it deviates
/// by `most_m`.
void expect_paths(const engine::Context& context, const SelfSubstep& substep, std::span<const Point> at,
                  float most_m, SelfContact& self);

/// Writes to `now` the positions at which contact with the body is expected to leave the points that
/// constraints moved. A particle on the body is put back to at most `most_m` from where its smoothed velocity
/// leads. Constraints pull cloth that is much too small by more than an edge in a substep, and lists of pairs
/// would otherwise contain all of it.
void expect_contact_positions(const engine::Context& context, const SelfSubstep& substep, float most_m,
                              const Particles& particles, SelfContact& self);

/// Moves points back to at most `most_m` from where their smoothed velocities lead, for particles on a moving
/// body that have stretched edges. The body undoes the rest of what these edges pull them by, so that it must
/// not push other layers. Stores that rest in ExpectedPaths::pulled.
void hold_back_pulled(const engine::Context& context, const SelfSubstep& substep, float most_m,
                      Particles& particles, SelfContact& self);

/// Adds ExpectedPaths::pulled to the points.
void release_pulled(const engine::Context& context, const SelfSubstep& substep, Particles& particles,
                    SelfContact& self);

/// Updates the smoothed velocities (ExpectedPaths::drift) by those of a substep that ended at `now`.
void update_drift(const engine::Context& context, float substep_s, SelfContact& self);

}  // namespace bodice::cloth
