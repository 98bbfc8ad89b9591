// Deforms the skin from the rest pose to another pose.
#pragma once

#include <bodice/engine/context.hpp>

#include "mesh/weights.hpp"
#include "pose/pose.hpp"

namespace bodice::inline v0_1::synth {

/// Blends the bones' motions at each point as dual quaternions, so that bends and twists do not collapse.
std::vector<Vec3> deform(const engine::Context& context, const std::vector<Vec3>& rest,
                         const std::vector<BoneWeights>& weights, const BoneTransforms& bones);

}  // namespace bodice::synth
