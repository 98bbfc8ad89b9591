// The joint of an elbow.
#include <coefficients/elbow.hpp>

#include "landmarks/base/border_loop.hpp"
#include "landmarks/base/limb_joint.hpp"

namespace bodice::inline v0_1::anatomy {
namespace of_elbow {
namespace {

/// The distance from the fingertip, in units of hand to hand, beyond which the border's sign means nothing.
constexpr float kReach = 0.36F;
/// The range of elbows and, on straight arms, their mean on made and scanned bodies: shares of the path from
/// fingertip to armpit.
constexpr float kFrom = 0.40F, kTo = 0.85F, kShare = 0.635F;
/// One elbow in a hundred that is right lies farther from its second estimate, as a fraction of the body
/// size.
constexpr double kMaxDifference = 0.07;

FoundLandmark find(const LandmarkInput& input, int side) {
  FoundLandmark elbow;
  elbow.loop = border_loop(input.skin, input.coordinates, {kElbow, kOwnHand, kReach}, side);
  elbow.mark = {body::of_side(LandmarkId::kElbowL, side), elbow.loop.center, elbow.loop.vertex,
                elbow.loop.confidence};
  return elbow;
}

FoundLandmark refine(const LandmarkInput& input, const Landmarks& marks, int side) {
  FoundLandmark elbow = marks[body::of_side(LandmarkId::kElbowL, side)];
  elbow.mark.position =
      limb_joint(input, elbow.mark.id, elbow.loop,
                 {marks.at(LandmarkId::kArmpitL, side), input.skin.mesh.positions[input.tips().hand[side]],
                  coefficients::elbow::kUpper, coefficients::elbow::kLower});
  return elbow;
}

double difference(const LandmarkInput& input, const Landmarks& marks, int side) {
  const geodesic::Field& from_hand = *input.tips().from_hand[side];
  const geometry::Index armpit = marks[body::of_side(LandmarkId::kArmpitL, side)].mark.vertex;
  return joint_difference(input, {from_hand, from_hand[armpit], kFrom, kTo, kShare},
                          marks[body::of_side(LandmarkId::kElbowL, side)].loop);
}

}  // namespace
}  // namespace of_elbow

LandmarkKind elbow() {
  return {.id = LandmarkId::kElbowL,
          .paired = true,
          .part = body::Part::kUpperArmL,
          .find = of_elbow::find,
          .refine = of_elbow::refine,
          .checks = {{{of_elbow::difference, of_elbow::kMaxDifference,
                       "The elbow's border and the bend or the middle of the arm lie far from each other."}}},
          .doubt = 1,
          .recipe = Recipe::kCorrections};
}

}  // namespace bodice::anatomy
