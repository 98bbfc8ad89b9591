// Doubts about armpits and crotch that lie where no body with such limbs has them.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Warns of folds that lie far from where the other landmarks let expect them, and lowers their confidence:
/// of skins that were cut or that close holes, and of others where folds are farther off still.
void doubt_folds(const Options& options, Anatomy& anatomy);

}  // namespace bodice::anatomy
