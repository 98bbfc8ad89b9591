// Whether a posed skeleton passes through itself, by capsules around its bones.
#pragma once

#include "pose/pose.hpp"

namespace bodice::inline v0_1::synth {

/// The least distance between the capsules of limbs that are not neighbors, in statures. It is negative where
/// flesh would pass through flesh.
double clearance(const Figure& figure, const BoneTransforms& posed);

}  // namespace bodice::synth
