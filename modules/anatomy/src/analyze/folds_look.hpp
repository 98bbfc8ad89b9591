// Whether armpits and crotch look like folds, as evidence for limbs that were cut apart.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Whether the result for a body with hardly bent thighs is plausible although its folds cannot be predicted:
/// they look as on known bodies, and the stature is that of the joints.
bool looks_right(const Anatomy& apart);

/// Whether folds that limbs and trunk predict better than those of a skin that shows no other sign of welds
/// are evidence enough against that skin: they look right, or no worse than folds that are in doubt in any
/// case.
bool outweighs_skin(const Anatomy& apart, const Anatomy& as_is);

}  // namespace bodice::anatomy
