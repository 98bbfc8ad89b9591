// The tip of the longest finger: the end of the hand.
#include "landmarks/base/far_end.hpp"
#include "landmarks/base/landmark_kind.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_fingertip {
namespace {

/// The cross-check looks for the fingertip this near to the first estimate, as a fraction of the body size.
constexpr float kNearEnd = 0.08F;
/// One fingertip in a hundred that is right lies farther from its second estimate, as a fraction of the body
/// size.
constexpr double kMaxDifference = 0.02;

FoundLandmark find(const LandmarkInput& input, int side) {
  const geometry::Index tip = input.tips().hand[side];
  return {{body::of_side(LandmarkId::kFingertipL, side), input.skin.mesh.positions[tip], tip, 1.0}, {}};
}

double difference(const LandmarkInput& input, const Landmarks& marks, int side) {
  return difference_from_far_end(input, *input.tips().from_hand[side],
                                 marks.at(LandmarkId::kFingertipL, side), kNearEnd);
}

}  // namespace
}  // namespace of_fingertip

LandmarkKind fingertip() {
  return {
      .id = LandmarkId::kFingertipL,
      .paired = true,
      .part = body::Part::kForearmL,
      .find = of_fingertip::find,
      .checks = {{{of_fingertip::difference, of_fingertip::kMaxDifference,
                   "The fingertip and the point of the hand that is farthest from the trunk lie apart."}}}};
}

}  // namespace bodice::anatomy
