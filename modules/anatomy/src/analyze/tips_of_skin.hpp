// The crown, the nape and the fingertips of a body that was found on a thin copy.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Whether a warning is a doubt about the crown.
bool is_of_crown(const engine::Warning& warning);

/// Removes the warnings about the crown from `apart`, the result on a thin copy, if the skin itself has the
/// same crown without a warning: a thin copy has no ears, by which the length of a head is tested. Removes
/// the warning of a covered nape if the skin has none: a deep copy has no hollow there. Takes the positions
/// of the skin's fingertips where they are near and no limbs meet on it: a thin copy may have lost fingers.
/// Doubts about its own fingertips stay, because they are doubts about the arm.
void take_tips(const Anatomy& as_is, Anatomy& apart);

}  // namespace bodice::anatomy
