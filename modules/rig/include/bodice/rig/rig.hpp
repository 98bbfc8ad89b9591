// A rig: a skeleton, the weights that bind a skin to it, and clips that move it.
#pragma once

#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/rig/clip.hpp>
#include <bodice/rig/skeleton.hpp>
#include <bodice/rig/skinning.hpp>

namespace bodice::inline v0_1::rig {

/// A skeleton, the weights of the skin that it moves, and its clips.
struct Rig {
  Skeleton skeleton;
  SkinWeights weights;
  std::vector<Clip> clips;
};

/// Validates the skeleton and the clips and mends the weights of a skin of so many vertices; returns what was
/// mended. Fails with kUnusableGeometry, one sentence that names the joint or the clip, and one remedy.
/// O(#J + #weights + #keys).
engine::Result<std::vector<engine::Warning>> mend(Rig& rig, std::size_t vertices);

/// Reorders joints so that parents come before children, otherwise in the order given, and renumbers weights
/// and clips. Fails with kUnusableGeometry where a parent is missing or joints are their own ancestors.
/// O(#J).
engine::Result<void> put_parents_first(Rig& rig);

}  // namespace bodice::rig
