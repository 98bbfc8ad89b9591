// The axis of a limb.
#pragma once

#include <span>

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// Where a limb bends most, between two levels of the distance from its end.
struct Bend {
  float level = 0.0F;      ///< meters from the end of the limb
  float angle_rad = 0.0F;  ///< between the limb's axes before and behind; 0 on a straight one
};

/// Reads the limb's axis as middles of the skin between equally spaced levels. O(#F).
Bend sharpest_bend(const Skin& skin, std::span<const float> from_end, float from, float to);

}  // namespace bodice::anatomy
