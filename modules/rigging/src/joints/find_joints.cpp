#include <bodice/engine/message.hpp>

#include "joints/found_joints.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using body::Part;

engine::Error unusable(std::string message) {
  return {engine::ErrorCode::kUnusableGeometry, std::move(message),
          "Give a body with head, arms and legs, of which no limb is grown together with another part."};
}

struct Border {
  const char* name;
  PartSet inside;
  Ring* ring;
};

}  // namespace

engine::Result<BorderRings> find_border_rings(const SkinCurves& skin) {
  BorderRings rings;
  const PartSet legs = parts({Part::kThighL, Part::kThighR, Part::kCalfL, Part::kCalfR});
  const PartSet arms = parts({Part::kUpperArmL, Part::kUpperArmR, Part::kForearmL, Part::kForearmR});
  const PartSet head = parts({Part::kHead});
  const Border borders[] = {
      {"the left arm and the torso", parts({Part::kUpperArmL, Part::kForearmL}), &rings.shoulder[0]},
      {"the right arm and the torso", parts({Part::kUpperArmR, Part::kForearmR}), &rings.shoulder[1]},
      {"the left leg and the torso", parts({Part::kThighL, Part::kCalfL}), &rings.hip[0]},
      {"the right leg and the torso", parts({Part::kThighR, Part::kCalfR}), &rings.hip[1]},
      {"the lower and the middle torso", parts({Part::kTorsoLL, Part::kTorsoLR}) | legs, &rings.waist},
      {"the middle and the upper torso", parts({Part::kTorsoUL, Part::kTorsoUR}) | head | arms, &rings.chest},
      {"the head and the torso", head, &rings.neck}};
  for (const Border& border : borders) {
    const auto ring = skin.border(border.inside);
    if (!ring)
      return unusable(
          engine::message("The skin has no border between ", border.name, " to find a joint by."));
    *border.ring = *ring;
  }
  return rings;
}

engine::Result<FoundJoints> find_joints(const SkinCurves& skin) {
  const auto rings = find_border_rings(skin);
  if (!rings) return rings.error();
  FoundJoints joints;
  find_trunk(skin, *rings, joints);
  for (int side = 0; side < 2; ++side) {
    find_arm(skin, *rings, side, joints);
    find_leg(skin, *rings, side, joints);
  }
  const JointId spine[] = {JointId::kPelvis,     JointId::kSpineLower, JointId::kSpineMiddle,
                           JointId::kSpineUpper, JointId::kNeck,       JointId::kHead};
  for (int i = 0; i + 1 < 6; ++i) joints.tip(spine[i]) = joints.at(spine[i + 1]);
  constexpr double kShortestBone = 0.004;  // of the stature: below it two joints are one
  for (int i = 0; i < body::kJointCount; ++i) {
    const double length = (joints.end[i] - joints.position[i]).norm();
    if (!(length > kShortestBone * skin.anatomy().stature_m) || !joints.frame[i].allFinite())
      return unusable(engine::message("The joint \"", body::kJointNames[i],
                                      "\" cannot be found: its bone has a length of ", 1e3 * length, " mm."));
  }
  return joints;
}

}  // namespace bodice::rigging
