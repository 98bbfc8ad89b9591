// The tip of a foot.
#include "landmarks/base/far_end.hpp"
#include "landmarks/base/landmark_kind.hpp"
#include "skin/soft_position.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_toe {
namespace {

/// How much nearer to the head than its tip the front of a foot reaches, and how far to the sides: fractions
/// of the distance from head to feet.
constexpr float kBlunt = 0.010F, kToes = 0.04F;
/// The cross-check looks for the toe this near to the first estimate, as a fraction of the body size.
constexpr float kNearEnd = 0.08F;
/// One toe in a hundred that is right lies farther from its second estimate, as a fraction of the body size.
constexpr double kMaxDifference = 0.035;

FoundLandmark find(const LandmarkInput& input, int side) {
  const geometry::Index tip = input.tips().foot[side];
  return {{body::of_side(LandmarkId::kToeL, side), input.skin.mesh.positions[tip], tip, 1.0}, {}};
}

/// The front of a foot is blunt: what is nearly as far from the head as its farthest vertex has a share.
FoundLandmark finish(const LandmarkInput& input, const Landmarks& marks, int side) {
  const BodyExtremities& tips = input.tips();
  const float blunt = kBlunt * tips.head_to_feet;
  const geodesic::Field &own = *tips.from_foot[side], &other = *tips.from_foot[1 - side];
  const float tip = (*tips.from_head)[tips.foot[side]];
  FoundLandmark toe = marks[body::of_side(LandmarkId::kToeL, side)];
  toe.mark.position = soft_position(
      input.skin, tips.foot[side], static_cast<double>(kToes * tips.head_to_feet), [&](geometry::Index v) {
        return own[v] < other[v] ? std::max(0.0F, blunt - std::abs(tip - (*tips.from_head)[v])) : 0.0F;
      });
  return toe;
}

double difference(const LandmarkInput& input, const Landmarks&, int side) {
  const geometry::Vec3& tip = input.skin.mesh.positions[input.tips().foot[side]];
  return difference_from_far_end(input, *input.tips().from_foot[side], tip, kNearEnd);
}

}  // namespace
}  // namespace of_toe

LandmarkKind toe() {
  return {.id = LandmarkId::kToeL,
          .paired = true,
          .part = body::Part::kCalfL,
          .find = of_toe::find,
          .finish = of_toe::finish,
          .checks = {{{of_toe::difference, of_toe::kMaxDifference,
                       "The tip of the foot and the point of the foot that is farthest from the trunk lie "
                       "apart."}}}};
}

}  // namespace bodice::anatomy
