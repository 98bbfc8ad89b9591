// Doubts about armpits and crotch that lie where no body with such limbs has them.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Warns of folds that lie far from where the other landmarks let expect them, and lowers their confidence.
/// Skins that were neither cut nor closed are doubted where armpits are farther off still.
void doubt_folds(const Options& options, Anatomy& anatomy);

}  // namespace bodice::anatomy
