// The rig of a made body: its own bones, in the frames of the common skeleton.
#pragma once

#include <bodice/rig/skeleton.hpp>
#include <bodice/rig/skinning.hpp>
#include <bodice/synth/body.hpp>

#include "mesh/weights.hpp"
#include "pose/pose.hpp"

namespace bodice::inline v0_1::synth {

/// A joint a bone, bound in the pose that `bones` make of the rest pose; `joints` are their final positions.
rig::Skeleton true_skeleton(const BoneTransforms& bones, const std::vector<Joint>& joints);

/// Skin weights without those below a ten-thousandth; the others sum to 1.
rig::SkinWeights sparse_weights(const std::vector<BoneWeights>& weights);

}  // namespace bodice::synth
