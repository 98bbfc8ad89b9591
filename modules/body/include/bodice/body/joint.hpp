// The common skeleton: the joints that every made or found rig has, their names and their hierarchy.
//
//   head - neck - spine_upper - spine_middle - spine_lower - pelvis
//                  |                                          |
//           clavicle - upper_arm - forearm - hand      thigh - calf - foot - toes
//
// Joint frames: in the reference pose (standing, arms hanging with the palms inward, feet flat) the axes of
// every joint are the body's: x to its left, y up, z to the front. So one set of rotations fits every body.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::body {

/// Each is the near end of the bone that it is named after: kForearmL is the left elbow. Limbs are in pairs,
/// left first; parents come before children.
enum class JointId : std::uint8_t {
  kPelvis,
  kSpineLower,
  kSpineMiddle,
  kSpineUpper,
  kNeck,
  kHead,
  kClavicleL,
  kClavicleR,
  kUpperArmL,
  kUpperArmR,
  kForearmL,
  kForearmR,
  kHandL,
  kHandR,
  kThighL,
  kThighR,
  kCalfL,
  kCalfR,
  kFootL,
  kFootR,
  kToesL,
  kToesR,
};

inline constexpr int kJointCount = 22;

inline constexpr std::array<std::string_view, kJointCount> kJointNames = {
    "pelvis",     "spine_lower", "spine_middle", "spine_upper", "neck",      "head",
    "clavicle_l", "clavicle_r",  "upper_arm_l",  "upper_arm_r", "forearm_l", "forearm_r",
    "hand_l",     "hand_r",      "thigh_l",      "thigh_r",     "calf_l",    "calf_r",
    "foot_l",     "foot_r",      "toes_l",       "toes_r"};

/// The name of a joint in files and messages, such as "upper_arm_l".
constexpr std::string_view name(JointId id) {
  return kJointNames[static_cast<int>(id)];
}

/// The joint of a name; nothing if no joint has it.
constexpr std::optional<JointId> joint_from_name(std::string_view text) {
  for (int i = 0; i < kJointCount; ++i)
    if (kJointNames[i] == text) return static_cast<JointId>(i);
  return std::nullopt;
}

/// The left joint's pair on a side: 0 left, 1 right.
constexpr JointId of_side(JointId left, int side) {
  return static_cast<JointId>(static_cast<int>(left) + side);
}

/// The joint that carries this one; the pelvis, which nothing carries, gives itself.
constexpr JointId parent(JointId id) {
  constexpr std::array<std::uint8_t, kJointCount> kParents = {0, 0,  1,  2, 3, 4,  3,  3,  6,  7,  8,
                                                              9, 10, 11, 0, 0, 14, 15, 16, 17, 18, 19};
  return static_cast<JointId>(kParents[static_cast<int>(id)]);
}

// The height of the ankle (the foot's joint) above the sole, as a multiple of how far the ball of the foot
// (the toes' joint) lies below the ankle. Every common skeleton keeps to it, so that its sole is known
// without a skin.
inline constexpr double kAnkleHeightOverDrop = 1.0 / 0.6;

}  // namespace bodice::body
