// How much each bone carries of the skin.
#pragma once

#include <array>
#include <vector>

#include <bodice/body/part.hpp>

#include "mesh/skin.hpp"

namespace bodice::synth {

using BoneWeights = Eigen::Matrix<float, kBoneCount, 1>;  ///< sums to 1

/// One bone a vertex by its place in the rest pose, then smoothed over the surface, so that nothing leaks
/// across the gap between an arm and the trunk. #design vertices.
std::vector<BoneWeights> bone_weights(const Figure& figure, const Skin& skin);

/// Limb and trunk as a bone's skin is labeled; the trunk as its lower left part.
body::Part part_of(Bone bone);

/// Share of the weights on each part's bones; the trunk's under kTorsoLL.
std::array<float, body::kPartCount> part_shares(const BoneWeights& weights);

}  // namespace bodice::synth
