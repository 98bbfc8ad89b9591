// Pelvis, spine, neck, head and clavicles.
#include <bodice/geometry/smallest_turn.hpp>

#include "joints/found_joints.hpp"
#include "joints/offsets.hpp"
#include "posture/turns.hpp"

namespace bodice::rigging {
namespace {

using body::JointId;
using body::LandmarkId;

Mat3 between(const Mat3& a, const Mat3& b, double share) {
  return Eigen::Quaterniond(a).slerp(share, Eigen::Quaterniond(b)).toRotationMatrix();
}

Vec3 spine_joint(const Ring& ring, const offsets::SpineOffset& o, const Mat3& pelvis, const Mat3& chest,
                 double h) {
  return ring.center + h * (o.pelvis_up * pelvis.col(1) + o.pelvis_front * pelvis.col(2) +
                            o.chest_up * chest.col(1) + o.chest_front * chest.col(2));
}

void find_head(const SkinCurves& skin, const Mat3& chest_axes, FoundJoints& joints) {
  const double h = skin.anatomy().stature_m;
  const Vec3 neck = skin.landmark(LandmarkId::kNeck).position,
             crown = skin.landmark(LandmarkId::kCrown).position;
  const Mat3& chest = joints.axes(JointId::kSpineUpper);
  joints.at(JointId::kNeck) =
      neck + h * (offsets::kNeckUp * chest_axes.col(1) + offsets::kNeckFront * chest_axes.col(2));
  joints.at(JointId::kHead) =
      neck + offsets::kHeadShare * (crown - neck) +
      h * (offsets::kHeadUp * chest_axes.col(1) + offsets::kHeadFront * chest_axes.col(2));
  const Vec3 upright = chest * about_x(offsets::kHeadLean_deg) * Vec3::UnitY();
  const Mat3 head = geometry::smallest_turn(upright, (crown - neck).normalized()).toRotationMatrix() * chest;
  joints.axes(JointId::kHead) = head;
  joints.axes(JointId::kNeck) = between(chest, head, 0.5);
  joints.tip(JointId::kHead) = crown;
}

}  // namespace

void find_trunk(const SkinCurves& skin, const BorderRings& rings, FoundJoints& joints) {
  const double h = skin.anatomy().stature_m;
  const Vec3 hips = 0.5 * (rings.hip[0].center + rings.hip[1].center);
  // Axes along the lines between curves, which standing bodies do not hold upright; frames are upright there.
  const Mat3 pelvis_axes = frame_of(rings.hip[0].center - rings.hip[1].center, rings.waist.center - hips);
  const Mat3 chest_axes =
      frame_of(rings.shoulder[0].center - rings.shoulder[1].center, rings.neck.center - rings.waist.center);
  const Mat3 pelvis = pelvis_axes * about_x(-offsets::kPelvisLean_deg);
  const Mat3 chest = chest_axes * about_x(-offsets::kChestLean_deg);
  joints.axes(JointId::kPelvis) = pelvis;
  joints.axes(JointId::kSpineLower) = between(pelvis, chest, 1.0 / 3.0);
  joints.axes(JointId::kSpineMiddle) = between(pelvis, chest, 2.0 / 3.0);
  joints.axes(JointId::kSpineUpper) = chest;
  joints.at(JointId::kPelvis) = hips + h * offsets::kPelvisUp * pelvis_axes.col(1);
  joints.at(JointId::kSpineLower) =
      spine_joint(rings.waist, offsets::kSpineLower, pelvis_axes, chest_axes, h);
  joints.at(JointId::kSpineMiddle) =
      spine_joint(rings.chest, offsets::kSpineMiddle, pelvis_axes, chest_axes, h);
  joints.at(JointId::kSpineUpper) =
      spine_joint(rings.chest, offsets::kSpineUpper, pelvis_axes, chest_axes, h);
  find_head(skin, chest_axes, joints);
}

}  // namespace bodice::rigging
