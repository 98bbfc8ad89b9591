// Makes a skeleton in meters, y up, of a file's nodes, bindings and clips.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/rig/clip.hpp>

#include "import/scene/file_rig.hpp"

namespace bodice::inline v0_1::io {

struct BuiltSkeleton {
  rig::Skeleton skeleton;
  std::vector<std::uint16_t> joint_of_binding;  ///< #bindings of the file
  std::vector<rig::Clip> clips;
  std::vector<engine::Warning> warnings;  ///< clips that were left out
};

/// Joints are the bones, the nodes of the bindings in `used` (#bindings of the file), all below bones, and
/// all ancestors but those at the top that do nothing; where there are no bones, the nodes that a clip moves.
/// A node with a shear becomes two joints, and a node with several used bind poses gets a joint for each.
/// Fails with kUnusableGeometry and names the joint.
engine::Result<BuiltSkeleton> build_skeleton(const FileRig& file, const std::vector<bool>& used,
                                             const geometry::Frame& frame);

}  // namespace bodice::io
