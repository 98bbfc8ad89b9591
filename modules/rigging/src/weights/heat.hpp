// Smooth weights by the equilibrium of heat on the skin.
#pragma once

#include <bodice/engine/result.hpp>
#include <bodice/rig/skinning.hpp>

#include "weights/nearest_bone.hpp"

namespace bodice::inline v0_1::rigging {

/// The largest number of joints of a vertex, which is that of files.
inline constexpr int kInfluences = 4;

/// Each bone's weight is the heat that its own vertices give off: (L + A H) w = A H p with the cotangent
/// Laplacian L, vertex areas A, p = 1 on the bone's vertices and 0 elsewhere, H = c / distance to the bone
/// squared. One sparse factorization, then one solve a joint, in parallel. Limbs get no weight of the other
/// side's limb. Fails with kUnusableGeometry where the system is singular. O(#V^1.5) for a surface.
engine::Result<rig::SkinWeights> heat_weights(const engine::Context& context, const SkinCurves& skin,
                                              const NearestBone& nearest);

}  // namespace bodice::rigging
