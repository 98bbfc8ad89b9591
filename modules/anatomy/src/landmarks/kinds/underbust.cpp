// The middle of the trunk below the breasts.
#include <coefficients/underbust.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::anatomy {
namespace {

FoundLandmark find(const LandmarkInput& input, int) {
  return find_trunk_level(input, LandmarkId::kUnderbust, coefficients::underbust::kLevel);
}

}  // namespace

LandmarkKind underbust() {
  return {.id = LandmarkId::kUnderbust,
          .part = body::Part::kTorsoUL,
          .find = find,
          .recipe = Recipe::kTrunkLevel};
}

}  // namespace bodice::anatomy
