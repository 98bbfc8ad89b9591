// What a motion needs of a common skeleton: its lengths, and where it stands.
#pragma once

#include <array>

#include <bodice/body/joint.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/rig/skeleton.hpp>

#include "posture/posture.hpp"

namespace bodice::inline v0_1::rigging {

/// One leg's lengths, meters, and its ankle's height above the sole.
struct LegLengths {
  Vec3 hip = Vec3::Zero();  ///< the hip joint, from the pelvis joint, in the pelvis's frame
  double thigh = 0.0, calf = 0.0;
  Vec3 ball = Vec3::Zero();  ///< the ball of the foot on the sole, from the ankle, in the foot's frame
  double ankle_height = 0.0;
};

struct Figure {
  std::array<int, body::kJointCount> joint;  ///< index in the skeleton, -1 where it has none
  std::array<LegLengths, 2> leg;             ///< left, right
  Vec3 hips_middle = Vec3::Zero();  ///< of both hip joints, from the pelvis joint, in the pelvis's frame
  double leg_m = 0.0;               ///< height of the hips above the soles, standing with straight legs
  double hip_half_width = 0.0;      ///< units of the leg
  Mat3 heading = Mat3::Identity();  ///< motion space to skin space
  Vec3 origin = Vec3::Zero();       ///< of motion space, in skin space

  int index(body::JointId id) const { return joint[static_cast<int>(id)]; }
};

/// Fails with kInvalidArgument where the skeleton is not the common one.
engine::Result<Figure> measure(const rig::Skeleton& skeleton);

}  // namespace bodice::rigging
