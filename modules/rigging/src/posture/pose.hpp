// Turns a posture into the local rotations of a skeleton's joints.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include "posture/figure.hpp"

namespace bodice::inline v0_1::rigging {

struct JointPose {
  Vec3 pelvis = Vec3::Zero();                                  ///< position of the root, skin space, meters
  std::array<Eigen::Quaterniond, body::kJointCount> rotation;  ///< joint to the joint that carries it
};

/// How high the hips must come down, units of the leg, so that both legs reach their feet; 0 where they do. A
/// leg counts as stretched a little before it is straight, where its knee would snap.
double missing_reach(const Figure& figure, const Posture& posture);

/// Solves the legs for the feet. `lower` is taken off the height of the hips.
JointPose pose_joints(const Figure& figure, const Posture& posture, double lower);

}  // namespace bodice::rigging
