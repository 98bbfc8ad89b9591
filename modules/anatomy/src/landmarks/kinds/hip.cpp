// The middle of the trunk at the level where the seat reaches farthest back.
#include <coefficients/hip.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_hip {
namespace {

FoundLandmark find(const LandmarkInput& input, int) {
  return find_trunk_level(input, LandmarkId::kHip, coefficients::hip::kLevel);
}

}  // namespace
}  // namespace of_hip

LandmarkKind hip() {
  return {.id = LandmarkId::kHip,
          .part = body::Part::kTorsoLL,
          .find = of_hip::find,
          .recipe = Recipe::kTrunkLevel};
}

}  // namespace bodice::anatomy
