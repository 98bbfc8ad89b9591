// The expected paths of particles.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "selfcontact/expected_paths.hpp"

using namespace bodice;

TEST_CASE("expected paths: the smoothed velocity of cloth at rest becomes zero, and is never subnormal") {
  cloth::SelfContact self;
  self.before.resize(3), self.now.resize(3), self.paths.drift.resize(3);
  self.paths.drift[1] = {1e-3f, 0.0f, -2.0f, 0.0f};
  self.paths.drift[2] = {3e-9f, 1e-12f, 0.0f, 0.0f};
  for (int substep = 0; substep < 1000; ++substep) {
    cloth::update_drift({}, 1.0f / 480.0f, self);
    for (const cloth::Point& drift : self.paths.drift)
      for (const float along : {drift.x, drift.y, drift.z}) CHECK(std::fpclassify(along) != FP_SUBNORMAL);
  }
  for (const cloth::Point& drift : self.paths.drift) CHECK(std::abs(drift.x) + std::abs(drift.z) == 0.0f);
}
