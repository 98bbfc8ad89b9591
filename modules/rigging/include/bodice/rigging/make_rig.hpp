// A rig for a body that has none: its joints from landmarks and parts, its skin weights from the mesh.
#pragma once

#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/rig/rig.hpp>

namespace bodice::inline v0_1::rigging {

/// A rig that was made for a skin without one.
struct FoundRig {
  rig::Rig rig;  ///< the 22 joints of body::JointId, bound to the skin as it is; no clips
  std::vector<engine::Warning> warnings;  ///< those of anatomy, which hold for the rig as well
  std::vector<engine::StageTime> stages;  ///< joints, weights
};

/// Rigs a repaired skin (meters, y up) in any pose. Joint frames are those of the common skeleton
/// (body/joint.hpp), so that make_clip() moves it. Each vertex has at most four joints, and a limb none of
/// the other side's limbs. Fails with kUnusableGeometry when parts do not meet or joints fall together, as
/// with limbs grown into the trunk; the sentence names them. Deterministic for any worker count. Half a
/// second for 13,000 vertices on one thread. Based on: Ilya Baran, Jovan Popovic. Automatic rigging and
/// animation of 3D characters. 2007.
engine::Result<FoundRig> make_rig(const engine::Context& context, const geometry::TriMesh& skin,
                                  const anatomy::Anatomy& anatomy);

}  // namespace bodice::rigging
