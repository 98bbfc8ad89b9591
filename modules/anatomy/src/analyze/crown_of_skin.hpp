// The crown of a body that was found on a thin copy.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// A thin copy has lost the ears, by which the length of a head is judged. Where the skin as it is has the
/// same crown, and nothing against it, the doubts of the copy about it are dropped from `apart`.
void judge_crown(const Anatomy& as_is, Anatomy& apart);

}  // namespace bodice::anatomy
