// A posture in numbers that mean the same for every body: angles in degrees, lengths in units of the leg.
//
// The space of a motion: the origin on the floor below the hips of the standing body, x to its left, y up, z
// to where it faces. A leg is the height of the hip joints above the soles.
#pragma once

#include <array>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::rigging {

using geometry::Mat3;
using geometry::Vec3;

/// The turns of an arm, in degrees, from one that hangs straight down with its palm inward. They apply in the
/// order twist, raise, forward.
struct ArmPosture {
  double raise = 10.0;   ///< away from the trunk, in the frontal plane
  double forward = 0.0;  ///< swing to the front
  double twist = 0.0;    ///< about the upper arm's axis, inward positive
  double elbow = 14.0;
  double wrist = 0.0;  ///< palm toward the forearm
};

struct FootPosture {
  Vec3 ground = Vec3::Zero();  ///< under the ankle of the flat foot; y is how far the sole is lifted
  double pitch = 0.0;          ///< toes up, about the heel; below 0 heel up, about the ball; toes stay flat
  double yaw = 0.0;            ///< heading of the foot, to the left
  double toes = 0.0;           ///< most bend of the toes while the heel is up
};

struct Posture {
  Vec3 hips = Vec3::Zero();                   ///< shift of the middle of the hips from standing upright
  double yaw = 0.0, pitch = 0.0, roll = 0.0;  ///< of the pelvis: to the left, forward, right side down
  double lean = 0.0, bend = 0.0, turn = 0.0;  ///< of the spine, in all: forward, to the left, to the left
  double nod = 0.0, look = 0.0;               ///< of neck and head, in all: forward, to the left
  double knee_out = 0.0;                      ///< how far the knees point outward of the feet and hips
  std::array<ArmPosture, 2> arm;              ///< left, right
  std::array<FootPosture, 2> foot;            ///< left, right
};

}  // namespace bodice::rigging
