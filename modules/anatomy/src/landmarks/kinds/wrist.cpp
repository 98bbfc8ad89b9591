// The joint of a wrist, at the center of its girth.
#include <coefficients/wrist.hpp>

#include "landmarks/base/landmark_kind.hpp"
#include "landmarks/base/level_loop.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_wrist {
namespace {

/// The distance from the fingertip, in units of hand to hand, beyond which the level means nothing.
constexpr float kReach = 0.17F;

FoundLandmark find(const LandmarkInput& input, int side) {
  return find_limb_level(input, LandmarkId::kWristL, side, kOwnHand, kReach, coefficients::wrist::kLevel);
}

}  // namespace
}  // namespace of_wrist

LandmarkKind wrist() {
  return {.id = LandmarkId::kWristL,
          .paired = true,
          .part = body::Part::kForearmL,
          .find = of_wrist::find,
          .recipe = Recipe::kLimbLevel};
}

}  // namespace bodice::anatomy
