// The joint of a knee.
#include <coefficients/knee.hpp>

#include "landmarks/base/border_loop.hpp"
#include "landmarks/base/limb_joint.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_knee {
namespace {

/// The distance from the toe, in units of foot to foot, beyond which the border's sign means nothing.
constexpr float kReach = 0.40F;
/// How far the knee's loop lies beyond the border of the calf, as a score.
constexpr float kBeyond = 0.0115F;
/// The range of knees and, on straight legs, their mean on made and scanned bodies: shares of the path from
/// toe to perineum.
constexpr float kFrom = 0.38F, kTo = 0.92F, kShare = 0.61F;
/// One knee in a hundred that is right lies farther from its second estimate, as a fraction of the body size.
constexpr double kMaxDifference = 0.038;

FoundLandmark find(const LandmarkInput& input, int side) {
  FoundLandmark knee;
  knee.loop = border_loop(input.skin, input.coordinates, {kKnee, kOwnFoot, kReach, kBeyond}, side);
  knee.mark = {body::of_side(LandmarkId::kKneeL, side), knee.loop.center, knee.loop.vertex,
               knee.loop.confidence};
  return knee;
}

FoundLandmark refine(const LandmarkInput& input, const Landmarks& marks, int side) {
  FoundLandmark knee = marks[body::of_side(LandmarkId::kKneeL, side)];
  knee.mark.position =
      limb_joint(input, knee.mark.id, knee.loop,
                 {marks.at(LandmarkId::kPerineum), input.skin.mesh.positions[input.tips().foot[side]],
                  coefficients::knee::kUpper, coefficients::knee::kLower});
  return knee;
}

double difference(const LandmarkInput& input, const Landmarks& marks, int side) {
  const geodesic::Field& from_foot = *input.tips().from_foot[side];
  const geometry::Index perineum = marks[LandmarkId::kPerineum].mark.vertex;
  return joint_difference(input, {from_foot, from_foot[perineum], kFrom, kTo, kShare},
                          marks[body::of_side(LandmarkId::kKneeL, side)].loop);
}

}  // namespace
}  // namespace of_knee

LandmarkKind knee() {
  return {.id = LandmarkId::kKneeL,
          .paired = true,
          .part = body::Part::kThighL,
          .find = of_knee::find,
          .refine = of_knee::refine,
          .checks = {{{of_knee::difference, of_knee::kMaxDifference,
                       "The knee's border and the bend or the middle of the leg lie far from each other."}}},
          .doubt = 1,
          .recipe = Recipe::kCorrections};
}

}  // namespace bodice::anatomy
