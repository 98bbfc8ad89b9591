// Where particles are expected to go, which decides how often pairs are searched anew.
#pragma once

#include "selfcontact/self_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// Where the last search expects particles to be by now, and how far from there they may be.
struct Expectation {
  const SelfContact& self;
  float share, most_m;

  /// `since_s` after the search, with all particles no farther than `most_m` and what each is allowed beyond
  /// that.
  Expectation(float since_s, float most_m, const SelfContact& self);

  /// How far particle i at `at` is from there, squared, square meters.
  float off2(std::span<const Point> at, std::size_t i) const {
    const Float4 off = xyz(load(at[i]) - load(self.found[i]) - share * load(self.ahead[i]));
    return dot(off, off);
  }
  /// Whether particle i may be so far from there, the square of a distance.
  bool allows(float off2, std::size_t i) const {
    const float allowed_m = most_m + self.beyond_m[i];
    return off2 <= allowed_m * allowed_m;
  }
};

/// Finds how far the particles at `at` are off their expected paths, `since_s` after the search; returns
/// whether any is by more than `most_m`, and what it is allowed beyond that.
bool strays(const engine::Context& context, std::span<const Point> at, float since_s, float most_m,
            SelfContact& self);

/// The same of the particles of some leaves alone, on the calling thread.
bool any_strays(std::span<const std::uint32_t> leaves, std::span<const Point> at, float since_s, float most_m,
                SelfContact& self);

/// How far any of a leaf's particles is off its expected path, meters.
float off_of(std::size_t leaf, const SelfContact& self);

/// Expects that particles go on as they did, for a frame; and those that are at `at`, farther from there than
/// `most_m`, that they stray no more than that.
void look_ahead(const engine::Context& context, const SelfSubstep& substep, std::span<const Point> at,
                float most_m, SelfContact& self);

/// Writes to `now` where contact with the body is expected to leave the points that constraints moved. What
/// lies on the body is put back, so that it counts as no farther from its drift than `most_m`: cloth that is
/// much too small is pulled by an edge and more a substep, and lists of pairs would hold all of it.
void foresee(const engine::Context& context, const SelfSubstep& substep, float most_m,
             const Particles& particles, SelfContact& self);

/// Adds the velocities of a substep, which ended at `now`, to the smoothed ones.
void follow_drift(const engine::Context& context, float substep_s, SelfContact& self);

}  // namespace bodice::cloth
