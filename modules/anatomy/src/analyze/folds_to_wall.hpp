// The folds up to which limbs need a wall to be apart.
#pragma once

#include <vector>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// The folds without armpits of raised arms that skin and copy have alike: such arms do not grow into the
/// trunk, and walls beside them move the armpits. `seen`: webs of the skin, `rough`: the result on the copy.
std::vector<Fold> folds_to_wall(std::vector<Fold> folds, const std::vector<Web>& seen, const Anatomy& rough,
                                const Anatomy& as_is);

}  // namespace bodice::anatomy
