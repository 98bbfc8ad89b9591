// The level where an arm widens into the trunk.
#pragma once

#include "skin/girth_profile.hpp"

namespace bodice::inline v0_1::anatomy {

/// How far from the fingertip, along the skin, the loop around the arm widens into the trunk: where it is
/// well above the girth of the upper arm. Read from the mesh alone, in any pose. `hands_apart`: from
/// fingertip to fingertip, meters. 0 where nothing widens, for instance on an arm that is welded to the
/// trunk.
float shoulder_level(const Skin& skin, std::span<const float> from_hand, float hands_apart);

}  // namespace bodice::anatomy
