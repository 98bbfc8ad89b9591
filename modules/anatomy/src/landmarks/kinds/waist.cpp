// The middle of the trunk at the level of the waist.
#include <coefficients/waist.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_waist {
namespace {

FoundLandmark find(const LandmarkInput& input, int) {
  return find_trunk_level(input, LandmarkId::kWaist, coefficients::waist::kLevel);
}

}  // namespace
}  // namespace of_waist

LandmarkKind waist() {
  return {.id = LandmarkId::kWaist,
          .part = body::Part::kTorsoML,
          .find = of_waist::find,
          .recipe = Recipe::kTrunkLevel};
}

}  // namespace bodice::anatomy
