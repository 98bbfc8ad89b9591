// Joints that lie off a curve or a landmark of the skin by offsets that a program measures
// (modules/rigging/data/README.md).
#pragma once

#include <span>

#include "joints/found_joints.hpp"

namespace bodice::inline v0_1::rigging {

/// What the offsets of a joint count from, and along: joint = origin + axes * offsets.
struct OffsetFrame {
  Vec3 origin;
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 4> axes;  ///< meters a unit of each offset
};

/// Axes of the trunk along the lines between its curves, which standing bodies do not hold upright.
struct TrunkAxes {
  Vec3 hips;  ///< the middle of both hips' curves
  Mat3 pelvis, chest;
};
TrunkAxes trunk_axes(const BorderRings& rings);

/// Joints that have an offset frame; of a pair, the left one, and both do.
inline constexpr body::JointId kOffsetJoints[] = {
    body::JointId::kPelvis,     body::JointId::kSpineLower, body::JointId::kSpineMiddle,
    body::JointId::kSpineUpper, body::JointId::kNeck,       body::JointId::kHead,
    body::JointId::kUpperArmL,  body::JointId::kClavicleL,  body::JointId::kThighL};

/// Precondition: `joint` is one of kOffsetJoints or the right one of such a pair. Frames of the pelvis and of
/// the upper spine must be in `joints` for an arm and a leg, and neck and shoulder for a clavicle.
OffsetFrame offset_frame(body::JointId joint, const SkinCurves& skin, const BorderRings& rings,
                         const FoundJoints& joints);

/// The measured offsets of a joint, one an axis of its frame.
std::span<const double> measured_offsets(body::JointId joint);

/// Where the measured offsets put a joint.
Vec3 offset_joint(body::JointId joint, const SkinCurves& skin, const BorderRings& rings,
                  const FoundJoints& joints);

}  // namespace bodice::rigging
