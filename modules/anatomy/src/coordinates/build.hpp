// How a body is built, told by lengths along its skin.
#pragma once

#include <array>

#include "coordinates/body_coordinates.hpp"

namespace bodice::anatomy {

/// Of the size: hand to hand, foot to foot, perineum to crown, breastbone and back to where the legs merge,
/// breastbone and back to the crown, head to hands. (Head to feet is what foot to foot leaves of the size.)
using Build = std::array<float, 8>;

inline Build build_of(const BodyCoordinates& coordinates) {
  const BodyEnds& ends = coordinates.ends();
  Build build{ends.hands_apart,
              ends.feet_apart,
              coordinates.trunk_m(),
              coordinates.front_to_merge_m(),
              coordinates.back_to_merge_m(),
              coordinates.from_front()[ends.head],
              coordinates.from_back()[ends.head],
              0.5F * ((*ends.from_head)[ends.hand[0]] + (*ends.from_head)[ends.hand[1]])};
  for (float& length : build) length /= coordinates.size_m();
  return build;
}

}  // namespace bodice::anatomy
