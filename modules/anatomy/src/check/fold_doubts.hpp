// Doubts about armpits and crotch that lie where no body with such limbs has them, and about the neck.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Warns of folds far from the positions that other landmarks predict, and lowers their confidence. Skins
/// that were neither cut nor closed are doubted where armpits are farther off still, or both too low and
/// unlike folds. Of skins that were cut, the neck is doubted as well, where it looks unlike one.
void doubt_folds(const Options& options, Anatomy& anatomy);

/// Whether limbs were cut apart.
bool was_cut(const Anatomy& anatomy);

/// Whether some of the skin closes holes.
bool was_closed(const Options& options);

/// Whether webs may hide folds that no room inside the body shows: where the skin was closed, or hides both
/// armpits.
bool may_hide_folds(const Options& options, const Anatomy& anatomy);

}  // namespace bodice::anatomy
