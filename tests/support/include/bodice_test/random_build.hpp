// Bodies that stand, of random build, for suites that link bodice::synth.
#pragma once

#include <cstdint>

#include <bodice/engine/random.hpp>
#include <bodice/synth/body.hpp>

namespace bodice_test {

/// Options of a body of random sex, size, build and resolution. It stands, until a caller sets another pose.
inline bodice::synth::BodyOptions random_build(std::uint64_t seed) {
  bodice::engine::Random random(seed, 0x816);
  bodice::synth::BodyOptions options;
  options.sex = random.below(2) == 0 ? bodice::body::Sex::kFemale : bodice::body::Sex::kMale;
  options.stature_m = random.uniform(1.5, 1.95);
  options.mass_kg = random.uniform(18.5, 32.0) * options.stature_m * options.stature_m;
  options.vertices = static_cast<int>(random.uniform(3000.0, 9000.0));
  options.seed = seed + 100;
  return options;
}

}  // namespace bodice_test
