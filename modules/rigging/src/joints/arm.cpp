// Clavicle, shoulder, elbow and wrist.
#include "joints/offset_joints.hpp"
#include "joints/offsets.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::LandmarkId;
using body::of_side;
using body::Part;

/// Returns the center of the curve around the wrist. Where no curve closes there (a fist, fused fingers), the
/// point lies between elbow and fingertip.
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
  const double sign = side == 0 ? 1.0 : -1.0;
  const Mat3& chest = joints.axes(JointId::kSpineUpper);
  const Vec3 elbow = skin.landmark(of_side(LandmarkId::kElbowL, side)).position;
  const JointId shoulder_id = of_side(JointId::kUpperArmL, side),
                clavicle_id = of_side(JointId::kClavicleL, side);
  joints.at(shoulder_id) = offset_joint(shoulder_id, skin, rings, joints);
  joints.at(clavicle_id) = offset_joint(clavicle_id, skin, rings, joints);
  const Vec3 shoulder = joints.at(shoulder_id);
  const Vec3 wrist = find_wrist(skin, side, elbow);
  const Vec3 tip = skin.landmark(of_side(LandmarkId::kFingertipL, side)).position;
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
