// The middle of the trunk at the level where the seat reaches farthest back.
#include <coefficients/hip.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::anatomy {
namespace {

FoundLandmark find(const LandmarkInput& input, int) {
  return find_trunk_level(input, LandmarkId::kHip, coefficients::hip::kLevel);
}

}  // namespace

LandmarkKind hip() {
  return {.id = LandmarkId::kHip, .part = body::Part::kTorsoLL, .find = find, .recipe = Recipe::kTrunkLevel};
}

}  // namespace bodice::anatomy
