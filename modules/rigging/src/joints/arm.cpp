// Clavicle, shoulder, elbow and wrist.
#include "joints/found_joints.hpp"
#include "joints/offsets.hpp"

namespace bodice::rigging {
namespace {

using body::JointId;
using body::LandmarkId;
using body::of_side;
using body::Part;

/// Around the wrist; where no curve closes there (a fist, fused fingers), a point between elbow and
/// fingertip.
Vec3 find_wrist(const SkinCurves& skin, int side, const Vec3& elbow) {
  const body::Landmark& tip = skin.landmark(of_side(LandmarkId::kFingertipL, side));
  const double h = skin.anatomy().stature_m;
  const geodesic::Field from_tip = skin.distances_from(tip.vertex);
  const auto ring = skin.ring(from_tip, offsets::kHand * h, parts({part_of_side(Part::kForearmL, side)}));
  const Vec3 wrist = ring ? ring->center : Vec3(tip.position + 0.42 * (elbow - tip.position));
  return wrist + offsets::kWristUp * h * (elbow - wrist).normalized();
}

}  // namespace

void find_arm(const SkinCurves& skin, const BorderRings& rings, int side, FoundJoints& joints) {
  const double h = skin.anatomy().stature_m, sign = side == 0 ? 1.0 : -1.0;
  const Mat3& chest = joints.axes(JointId::kSpineUpper);
  const Vec3 elbow = skin.landmark(of_side(LandmarkId::kElbowL, side)).position;
  const Vec3 border = rings.shoulder[side].center, along = (elbow - border).normalized();
  const Vec3 shoulder =
      border + h * (offsets::kShoulder.along * along + offsets::kShoulder.side * sign * chest.col(0) +
                    offsets::kShoulder.up * chest.col(1) + offsets::kShoulder.front * chest.col(2));
  const Vec3 wrist = find_wrist(skin, side, elbow);
  const Vec3 tip = skin.landmark(of_side(LandmarkId::kFingertipL, side)).position;
  const Vec3 neck = joints.at(JointId::kNeck);
  joints.at(of_side(JointId::kClavicleL, side)) =
      neck + offsets::kClavicleShare * (shoulder - neck) +
      h * (offsets::kClavicleFront * chest.col(2) - offsets::kClavicleDown * chest.col(1));
  joints.at(of_side(JointId::kUpperArmL, side)) = shoulder;
  joints.at(of_side(JointId::kForearmL, side)) = elbow;
  joints.at(of_side(JointId::kHandL, side)) = wrist;

  const Mat3 upper = with_hinge(upper_arm_frame(chest, (elbow - shoulder).normalized(), sign),
                                (wrist - elbow).normalized(), 1.0);
  const Mat3 lower = bone_frame(upper, (wrist - elbow).normalized());
  joints.axes(of_side(JointId::kClavicleL, side)) = chest;
  joints.axes(of_side(JointId::kUpperArmL, side)) = upper;
  joints.axes(of_side(JointId::kForearmL, side)) = lower;
  joints.axes(of_side(JointId::kHandL, side)) = bone_frame(lower, (tip - wrist).normalized());
  joints.tip(of_side(JointId::kClavicleL, side)) = shoulder;
  joints.tip(of_side(JointId::kUpperArmL, side)) = elbow;
  joints.tip(of_side(JointId::kForearmL, side)) = wrist;
  joints.tip(of_side(JointId::kHandL, side)) = tip;
}

}  // namespace bodice::rigging
