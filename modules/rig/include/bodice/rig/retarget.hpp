// A clip of one skeleton carried over to another by the joints' names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/rig/clip.hpp>

namespace bodice::inline v0_1::rig {

/// The joints that were matched by name and those that were not.
struct RetargetReport {
  std::vector<std::string> matched;           ///< joints of the target that a joint of the source moves
  std::vector<std::string> unmatched_target;  ///< joints of the target that keep their rest rotation
  std::vector<std::string> unmatched_source;  ///< joints with keys in the clip that move nothing
  double root_scale = 1.0;                    ///< target's over source's height of the hips
};

/// A clip for the target's skeleton.
struct RetargetedClip {
  Clip clip;
  RetargetReport report;
};

/// The clip for another skeleton: each matched joint turns in the world, relative to its rest pose, as the
/// source's joint does; the hips move as the source's do, scaled by the height of the hips. Rest poses that
/// differ (arms down, arms out) are aligned by the directions of arms and legs. Scale keys are left out.
/// Fails with kInvalidArgument where the skeletons share fewer than four names. The page of this layer states
/// the limits. O(#key times x #J).
engine::Result<RetargetedClip> retarget(const Skeleton& source, const Clip& clip, const Skeleton& target);

/// A name without the marks of its convention: "mixamorig:LeftUpLeg", "upperleg01.L", "thigh_l", "lThigh",
/// "J_Bip_L_UpperLeg" all become "thigh_l". Names of no known convention come back in lower case.
std::string common_joint_name(std::string_view name);

}  // namespace bodice::rig
