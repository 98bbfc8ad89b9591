// The middle of the trunk below the breasts.
#include <coefficients/underbust.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_underbust {
namespace {

FoundLandmark find(const LandmarkInput& input, int) {
  return find_trunk_level(input, LandmarkId::kUnderbust, coefficients::underbust::kLevel);
}

}  // namespace
}  // namespace of_underbust

LandmarkKind underbust() {
  return {.id = LandmarkId::kUnderbust,
          .part = body::Part::kTorsoUL,
          .find = of_underbust::find,
          .recipe = Recipe::kTrunkLevel};
}

}  // namespace bodice::anatomy
