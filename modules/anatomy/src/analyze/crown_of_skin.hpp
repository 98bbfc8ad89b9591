// The crown of a body that was found on a thin copy.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Removes the warnings about the crown from `apart`, the result on a thin copy, if the skin itself has the
/// same crown without a warning. A thin copy has no ears, by which the length of a head is tested.
void drop_crown_doubts(const Anatomy& as_is, Anatomy& apart);

}  // namespace bodice::anatomy
