// How the borders of parts follow the build of a body, and what they are for a build that is not known.
#include <doctest/doctest.h>

#include <limits>

#include <coefficients/part_borders.hpp>

#include "segment/part_borders.hpp"

using namespace bodice;
using anatomy::Build;

namespace {

constexpr Build kMiddle = anatomy::to_floats(anatomy::coefficients::part_borders::kBuildMiddle),
                kSpread = anatomy::to_floats(anatomy::coefficients::part_borders::kBuildSpread);

/// The build in the middle, but for one measure, which is so many deviations off.
Build build_off(std::size_t measure, float deviations) {
  Build build = kMiddle;
  build[measure] += deviations * kSpread[measure];
  return build;
}

}  // namespace

TEST_CASE("the neck's border follows a build that is known, and is that of landmarks for any other") {
  const anatomy::PartBorders middle = anatomy::part_borders(kMiddle);
  CHECK(middle.neck.weight != anatomy::kNeck.weight);
  for (std::size_t measure = 0; measure < kMiddle.size(); ++measure) {
    CAPTURE(measure);
    for (const float side : {-1.0F, 1.0F}) {
      const auto known = anatomy::part_borders(build_off(measure, side * 2.4F));
      CHECK(known.neck.weight != middle.neck.weight);
      CHECK(known.neck.weight != anatomy::kNeck.weight);
      CHECK(anatomy::part_borders(build_off(measure, side * 2.6F)).neck.weight == anatomy::kNeck.weight);
    }
    Build broken = kMiddle;
    broken[measure] = std::numeric_limits<float>::quiet_NaN();
    CHECK(anatomy::part_borders(broken).neck.weight == anatomy::kNeck.weight);
  }
}

TEST_CASE("the other borders of parts follow a build as far as bodies are known, and no farther") {
  const anatomy::PartBorders middle = anatomy::part_borders(kMiddle);
  for (std::size_t measure = 0; measure < kMiddle.size(); ++measure) {
    CAPTURE(measure);
    const auto off = anatomy::part_borders(build_off(measure, 3.0F)),
               farther = anatomy::part_borders(build_off(measure, 9.0F));
    CHECK(off.shoulder.weight != middle.shoulder.weight);
    CHECK(off.shoulder.weight == farther.shoulder.weight);
    CHECK(off.hip.weight == farther.hip.weight);
    CHECK(off.waist.weight == farther.waist.weight);
    CHECK(off.knee.weight == farther.knee.weight);
    CHECK(off.elbow.weight == middle.elbow.weight);
  }
}
