// The one bone that carries each vertex before weights are smoothed: by the vertex's part, then by planes at
// joints.
#pragma once

#include "joints/found_joints.hpp"

namespace bodice::inline v0_1::rigging {

struct NearestBone {
  std::vector<body::JointId> bone;  ///< #V
  std::vector<double> distance_m;   ///< #V, to that bone
};

/// Parts keep limbs apart that touch: skin of an arm is an arm bone's however near the trunk lies. Where a
/// part has several bones, the plane through the joint between two divides them.
NearestBone nearest_bones(const engine::Context& context, const SkinCurves& skin, const FoundJoints& joints);

}  // namespace bodice::rigging
