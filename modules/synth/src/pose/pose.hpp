// Joint angles, and what they do to a skeleton.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include <bodice/synth/body.hpp>

#include "figure/figure.hpp"

namespace bodice::synth {

/// All angles in degrees, from the rest directions of anatomy: arms hanging, legs straight down.
struct ArmAngles {
  double raise = 45.0;   ///< away from the trunk, in the frontal plane
  double forward = 0.0;  ///< swing to the front, after the raise
  double twist = 0.0;    ///< about the upper arm's axis, inward positive
  double elbow = 4.0;
  double wrist = 0.0;  ///< palm toward the forearm
  double curl = 8.0;   ///< of each row of finger joints
};

struct LegAngles {
  double flex = 0.0;    ///< thigh to the front
  double spread = 5.0;  ///< away from the other leg
  double twist = 0.0;   ///< toes outward
  double knee = 1.0;
  double ankle = 0.0;  ///< toes up
};

struct PoseAngles {
  double pitch = 0.0, yaw = 0.0, roll = 0.0;  ///< of the whole body about x, y, z
  double lean = 0.0, bend = 0.0, turn = 0.0;  ///< of the spine, in all: forward, to the left, to the left
  double nod = 0.0, look = 0.0;               ///< of the head: forward, to the left
  std::array<ArmAngles, 2> arm;
  std::array<LegAngles, 2> leg;
};

/// kRandom: the seed's angles within the range of human joints. Others do not depend on the seed.
PoseAngles angles_of(Pose pose, std::uint64_t seed);

using BoneTransforms = std::array<Eigen::Isometry3d, kBoneCount>;

/// From the rest pose to the given one, by bone.
BoneTransforms transforms(const Figure& figure, const PoseAngles& angles);

/// The pose asked for; a random one is drawn again, at most 64 times, until no limb's core runs through
/// another or through the trunk.
BoneTransforms pose_figure(const Figure& figure, Pose pose, std::uint64_t seed);

}  // namespace bodice::synth
