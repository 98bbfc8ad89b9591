// The rest poses of two skeletons, and the rotations that turn one into the other.
#pragma once

#include <span>
#include <vector>

#include <bodice/rig/clip.hpp>

#include "match_joints.hpp"

namespace bodice::inline v0_1::rig {

/// World rotations (scales left out) and positions at rest, #J each.
struct RestFrames {
  std::vector<Eigen::Quaterniond> rotation;
  std::vector<Vec3> position;
};

RestFrames rest_frames(const Skeleton& skeleton);

/// Products of local rotations from the root, #J.
std::vector<Eigen::Quaterniond> world_rotations(const Skeleton& skeleton,
                                                std::span<const LocalTransform> local);

struct Alignment {
  Eigen::Quaterniond facing =
      Eigen::Quaterniond::Identity();     ///< about y: the source's front to the target's
  std::vector<Eigen::Quaterniond> align;  ///< of each target joint: its rest direction to that of the source
  Vec3 source_hips_at_rest = Vec3::Zero();
  /// Whether the rest pose of the source has no ground. The height of `source_hips_at_rest` is then that over
  /// the lowest joint.
  bool ground_unknown = false;
  double root_scale = 1.0;
};

/// Arms and legs turn by the rotation between the directions to their next matched joint; hands and fingers
/// with their forearm; trunk, head, collars, feet and toes not at all.
Alignment plan_alignment(const RestFrames& source_rest, const Skeleton& target, const RestFrames& target_rest,
                         const JointMatch& match);

}  // namespace bodice::rig
