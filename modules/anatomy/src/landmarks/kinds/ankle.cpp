// The joint of an ankle, at the center of its girth.
#include <coefficients/ankle.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_ankle {
namespace {

/// The distance from the toe, in units of foot to foot, beyond which the level means nothing.
constexpr float kReach = 0.24F;

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_limb_level(input, LandmarkId::kAnkleL, side, kOwnFoot, kReach, coefficients::ankle::kLevel);
}

}  // namespace
}  // namespace of_ankle

LandmarkKind ankle() {
  return {.id = LandmarkId::kAnkleL,
          .paired = true,
          .part = body::Part::kCalfL,
          .find = of_ankle::find,
          .recipe = Recipe::kLimbLevel};
}

}  // namespace bodice::anatomy
