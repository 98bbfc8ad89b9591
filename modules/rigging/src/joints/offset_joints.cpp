#include "joints/offset_joints.hpp"

#include <coefficients/joint_offsets.hpp>

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::LandmarkId;
using body::of_side;

namespace data = coefficients::joint_offsets;

// One offset an axis of the joint's frame.
static_assert(std::size(data::kPelvis) == 2 && std::size(data::kNeck) == 2 && std::size(data::kHead) == 3 &&
              std::size(data::kClavicle) == 3 && std::size(data::kUpperArm) == 4 &&
              std::size(data::kThigh) == 4 && std::size(data::kSpineLower) == 4 &&
              std::size(data::kSpineMiddle) == 4 && std::size(data::kSpineUpper) == 4);

/// The left one of a pair, a joint without a pair itself.
JointId left_of(JointId joint) {
  const auto i = static_cast<int>(joint), first = static_cast<int>(JointId::kClavicleL);
  return i < first ? joint : static_cast<JointId>(i - (i - first) % 2);
}

OffsetFrame make_frame(const Vec3& origin, std::initializer_list<Vec3> axes) {
  OffsetFrame frame{origin, {}};
  frame.axes.resize(3, static_cast<Eigen::Index>(axes.size()));
  Eigen::Index column = 0;
  for (const Vec3& axis : axes) frame.axes.col(column++) = axis;
  return frame;
}

/// The middle of a hip's curve, moved halfway to level with the other: both hips are level in their pelvis,
/// but a trunk that bends to a side looks as if one was higher. Of a body that strides, one curve was 20 mm
/// too high.
Vec3 level_hip(const BorderRings& rings, const TrunkAxes& trunk, int side) {
  const Vec3 up = (rings.waist.center - trunk.hips).normalized(),
             from_middle = rings.hip[side].center - trunk.hips;
  return rings.hip[side].center - 0.5 * from_middle.dot(up) * up;
}

/// The frame of a joint that lies off a curve of the torso: up and to the front along the axes of the pelvis
/// and of the chest.
OffsetFrame spine_frame(const Ring& ring, const TrunkAxes& trunk, double h) {
  return make_frame(ring.center, {h * trunk.pelvis.col(1), h * trunk.pelvis.col(2), h * trunk.chest.col(1),
                                  h * trunk.chest.col(2)});
}

/// The frame of a joint that lies off the curve where a limb begins: along the limb, and to the side, up and
/// to the front of what carries the limb.
OffsetFrame limb_frame(const Vec3& border, const Vec3& limb_joint, const Mat3& parent, double outward_h) {
  const double h = std::abs(outward_h);
  return make_frame(border, {h * (limb_joint - border).normalized(), outward_h * parent.col(0),
                             h * parent.col(1), h * parent.col(2)});
}

}  // namespace

TrunkAxes trunk_axes(const BorderRings& rings) {
  const Vec3 hips = 0.5 * (rings.hip[0].center + rings.hip[1].center);
  return {
      hips, frame_of(rings.hip[0].center - rings.hip[1].center, rings.waist.center - hips),
      frame_of(rings.shoulder[0].center - rings.shoulder[1].center, rings.neck.center - rings.waist.center)};
}

OffsetFrame offset_frame(JointId joint, const SkinCurves& skin, const BorderRings& rings,
                         const FoundJoints& joints) {
  const double h = skin.anatomy().stature_m;
  const TrunkAxes trunk = trunk_axes(rings);
  const Vec3 neck = skin.landmark(LandmarkId::kNeck).position;
  const JointId left = left_of(joint);
  const int side = static_cast<int>(joint) - static_cast<int>(left);
  const double outward_h = side == 0 ? h : -h;
  switch (left) {
    case JointId::kPelvis:
      return make_frame(trunk.hips, {h * trunk.pelvis.col(1), h * trunk.pelvis.col(2)});
    case JointId::kSpineLower:
      return spine_frame(rings.waist, trunk, h);
    case JointId::kSpineMiddle:
    case JointId::kSpineUpper:
      return spine_frame(rings.chest, trunk, h);
    case JointId::kNeck:
      return make_frame(neck, {h * trunk.chest.col(1), h * trunk.chest.col(2)});
    case JointId::kHead:
      return make_frame(neck, {skin.landmark(LandmarkId::kCrown).position - neck, h * trunk.chest.col(1),
                               h * trunk.chest.col(2)});
    case JointId::kUpperArmL:
      return limb_frame(rings.shoulder[side].center,
                        skin.landmark(of_side(LandmarkId::kElbowL, side)).position,
                        joints.axes(JointId::kSpineUpper), outward_h);
    case JointId::kClavicleL: {
      const Mat3& chest = joints.axes(JointId::kSpineUpper);
      const Vec3& from = joints.at(JointId::kNeck);
      return make_frame(
          from, {joints.at(of_side(JointId::kUpperArmL, side)) - from, h * chest.col(1), h * chest.col(2)});
    }
    default:
      return limb_frame(level_hip(rings, trunk, side),
                        skin.landmark(of_side(LandmarkId::kKneeL, side)).position,
                        joints.axes(JointId::kPelvis), outward_h);
  }
}

std::span<const double> measured_offsets(JointId joint) {
  switch (left_of(joint)) {
    case JointId::kPelvis:
      return data::kPelvis;
    case JointId::kSpineLower:
      return data::kSpineLower;
    case JointId::kSpineMiddle:
      return data::kSpineMiddle;
    case JointId::kSpineUpper:
      return data::kSpineUpper;
    case JointId::kNeck:
      return data::kNeck;
    case JointId::kHead:
      return data::kHead;
    case JointId::kUpperArmL:
      return data::kUpperArm;
    case JointId::kClavicleL:
      return data::kClavicle;
    default:
      return data::kThigh;
  }
}

Vec3 offset_joint(JointId joint, const SkinCurves& skin, const BorderRings& rings,
                  const FoundJoints& joints) {
  const OffsetFrame frame = offset_frame(joint, skin, rings, joints);
  const std::span<const double> offsets = measured_offsets(joint);
  return frame.origin + frame.axes * Eigen::Map<const Eigen::VectorXd>(
                                         offsets.data(), static_cast<Eigen::Index>(offsets.size()));
}

}  // namespace bodice::rigging
