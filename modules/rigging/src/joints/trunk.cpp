// Pelvis, spine, neck, head and clavicles.
#include <bodice/geometry/smallest_turn.hpp>

#include "joints/offset_joints.hpp"
#include "joints/offsets.hpp"
#include "posture/turns.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::LandmarkId;

Mat3 between(const Mat3& a, const Mat3& b, double share) {
  return Eigen::Quaterniond(a).slerp(share, Eigen::Quaterniond(b)).toRotationMatrix();
}

void find_head(const SkinCurves& skin, FoundJoints& joints) {
  const Vec3 neck = skin.landmark(LandmarkId::kNeck).position,
             crown = skin.landmark(LandmarkId::kCrown).position;
  const Mat3& chest = joints.axes(JointId::kSpineUpper);
  const Vec3 upright = chest * about_x(offsets::kHeadLean_deg) * Vec3::UnitY();
  const Mat3 head = geometry::smallest_turn(upright, (crown - neck).normalized()).toRotationMatrix() * chest;
  joints.axes(JointId::kHead) = head;
  joints.axes(JointId::kNeck) = between(chest, head, 0.5);
  joints.tip(JointId::kHead) = crown;
}

}  // namespace

void find_trunk(const SkinCurves& skin, const BorderRings& rings, FoundJoints& joints) {
  // Frames are upright where the lines between curves lean.
  const TrunkAxes axes = trunk_axes(rings);
  const Mat3 pelvis = axes.pelvis * about_x(-offsets::kPelvisLean_deg);
  const Mat3 chest = axes.chest * about_x(-offsets::kChestLean_deg);
  joints.axes(JointId::kPelvis) = pelvis;
  joints.axes(JointId::kSpineLower) = between(pelvis, chest, 1.0 / 3.0);
  joints.axes(JointId::kSpineMiddle) = between(pelvis, chest, 2.0 / 3.0);
  joints.axes(JointId::kSpineUpper) = chest;
  for (const JointId joint : {JointId::kPelvis, JointId::kSpineLower, JointId::kSpineMiddle,
                              JointId::kSpineUpper, JointId::kNeck, JointId::kHead})
    joints.at(joint) = offset_joint(joint, skin, rings, joints);
  find_head(skin, joints);
}

}  // namespace bodice::rigging
