// The joints of a skin: where they are, and how their frames are turned in the skin's pose.
#pragma once

#include <array>
#include <optional>

#include <bodice/body/joint.hpp>
#include <bodice/body/part.hpp>
#include <bodice/engine/result.hpp>

#include "joints/frames.hpp"
#include "skin/skin_curves.hpp"

namespace bodice::inline v0_1::rigging {

struct FoundJoints {
  std::array<Vec3, body::kJointCount> position{};
  std::array<Mat3, body::kJointCount> frame{};  ///< axes of the reference pose to those of the joint
  std::array<Vec3, body::kJointCount> end{};    ///< where the bone of the joint ends

  Vec3& at(body::JointId id) { return position[static_cast<std::size_t>(id)]; }
  const Vec3& at(body::JointId id) const { return position[static_cast<std::size_t>(id)]; }
  Mat3& axes(body::JointId id) { return frame[static_cast<std::size_t>(id)]; }
  const Mat3& axes(body::JointId id) const { return frame[static_cast<std::size_t>(id)]; }
  Vec3& tip(body::JointId id) { return end[static_cast<std::size_t>(id)]; }
  const Vec3& tip(body::JointId id) const { return end[static_cast<std::size_t>(id)]; }
};

/// The part that is meant on a side: side 0 gives `left` itself, side 1 its right counterpart.
constexpr body::Part part_of_side(body::Part left, int side) {
  return static_cast<body::Part>(static_cast<int>(left) + side);
}

/// The curves that joints are found from.
struct BorderRings {
  std::array<Ring, 2> shoulder, hip;  ///< where arms and legs meet the torso, left and right
  Ring waist, chest, neck;            ///< between lower, middle and upper torso, and below the head
};

/// Fails with kUnusableGeometry and names the parts that do not meet.
engine::Result<BorderRings> find_border_rings(const SkinCurves& skin);

void find_trunk(const SkinCurves& skin, const BorderRings& rings, FoundJoints& joints);
void find_arm(const SkinCurves& skin, const BorderRings& rings, int side, FoundJoints& joints);
void find_leg(const SkinCurves& skin, const BorderRings& rings, int side, FoundJoints& joints);

/// All of them. Fails with kUnusableGeometry where parts do not meet or joints fall together.
engine::Result<FoundJoints> find_joints(const SkinCurves& skin);

}  // namespace bodice::rigging
