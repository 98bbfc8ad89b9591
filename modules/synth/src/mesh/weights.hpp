// The weight of each bone at each vertex of the skin.
#pragma once

#include <array>
#include <vector>

#include <bodice/body/part.hpp>

#include "mesh/skin.hpp"

namespace bodice::inline v0_1::synth {

using BoneWeights = Eigen::Matrix<float, kBoneCount, 1>;  ///< sums to 1

/// Gives each vertex one bone by its position in the rest pose, then smooths over the surface, so that
/// nothing leaks across the gap between arm and trunk. #design vertices.
std::vector<BoneWeights> bone_weights(const Figure& figure, const Skin& skin);

/// The part that a bone's skin belongs to; for the trunk its lower left part.
body::Part part_of(Bone bone);

/// The share of the weights on each part's bones; that of the trunk stands under kTorsoLL.
std::array<float, body::kPartCount> part_shares(const BoneWeights& weights);

}  // namespace bodice::synth
