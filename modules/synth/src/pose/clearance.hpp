// Whether a posed skeleton runs through itself, by capsules around its bones.
#pragma once

#include "pose/pose.hpp"

namespace bodice::synth {

/// Least distance between the capsules of limbs that are not neighbors, units of stature; negative where
/// flesh would run through flesh.
double clearance(const Figure& figure, const BoneTransforms& posed);

}  // namespace bodice::synth
