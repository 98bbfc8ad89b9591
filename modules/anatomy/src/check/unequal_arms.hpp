// Arms of one body that would be of different lengths.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Doubts both elbows if one forearm with its hand is longer than the other, and the armpit that fits less if
/// one upper arm, or the line from the neck to one armpit, is. Fingers that a thin copy has lost on one side
/// move the landmarks of that arm alone. Precondition: limbs were cut apart.
void doubt_unequal_arms(Anatomy& anatomy);

}  // namespace bodice::anatomy
