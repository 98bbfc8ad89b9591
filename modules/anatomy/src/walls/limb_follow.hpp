// Limbs followed to where the slices no longer show them.
#pragma once

#include "walls/limb_tracks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Joins hands and fingers with their arm, and a limb that is lost in some slices and comes out again. An arm
/// that merges with the trunk below its armpit goes on to the side of the shoulder: hanging ones in a
/// straight line, those of a bent elbow along the side of the body. One that comes out of what it touches
/// goes on down by the length of a hand.
void follow_limbs(const Slices& slices, LimbTracks& limbs);

}  // namespace bodice::anatomy
