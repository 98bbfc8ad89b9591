#pragma once

#include "landmarks/base/correction.hpp"
#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// The perineum, corrected by the directions of the thighs and the build of the trunk. A single raised leg
/// moves the line between the legs to its own side and backward, more so with heavier thighs. Returns the
/// first estimate on a skin with fused limbs. Precondition: the first estimate and all other landmarks are
/// found. O(#V).
Corrected perineum_by_legs(const LandmarkInput& input, const Landmarks& marks);

}  // namespace bodice::anatomy
