// Joint angles, and the bone transforms that they give.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include <bodice/synth/body.hpp>

#include "figure/figure.hpp"

namespace bodice::inline v0_1::synth {

/// Angles of an arm. All angles are degrees, from the rest directions of anatomy: arms hanging, legs straight
/// down.
struct ArmAngles {
  double raise = 45.0;   ///< away from the trunk, in the frontal plane
  double forward = 0.0;  ///< swing to the front, after the raise
  double twist = 0.0;    ///< about the upper arm's axis, inward positive
  double elbow = 4.0;
  double wrist = 0.0;  ///< palm toward the forearm
  double curl = 8.0;   ///< bend of each row of finger joints
};

struct LegAngles {
  double flex = 0.0;    ///< thigh to the front
  double spread = 5.0;  ///< away from the other leg
  double twist = 0.0;   ///< toes outward
  double knee = 1.0;
  double ankle = 0.0;  ///< toes up
};

struct PoseAngles {
  double pitch = 0.0, yaw = 0.0, roll = 0.0;  ///< turns of the whole body about x, y and z
  double lean = 0.0, bend = 0.0, turn = 0.0;  ///< of the whole spine: forward, to the left, to the left
  double nod = 0.0, look = 0.0;               ///< of the head: forward, to the left
  std::array<ArmAngles, 2> arm;
  std::array<LegAngles, 2> leg;
};

/// The angles of a pose. Those of kRandom lie within the range of human joints and depend on the seed; others
/// do not.
PoseAngles angles_of(Pose pose, std::uint64_t seed);

using BoneTransforms = std::array<Eigen::Isometry3d, kBoneCount>;

/// The transform of each bone from the rest pose to the given one.
BoneTransforms transforms(const Figure& figure, const PoseAngles& angles);

/// The transforms of a pose. A random pose is drawn again, at most 64 times, until no limb's core passes
/// through another or through the trunk.
BoneTransforms pose_figure(const Figure& figure, Pose pose, std::uint64_t seed);

}  // namespace bodice::synth
