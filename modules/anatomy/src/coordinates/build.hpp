// How a body is built, by lengths along its skin.
#pragma once

#include <array>

#include "coordinates/body_coordinates.hpp"

namespace bodice::inline v0_1::anatomy {

/// Hand to hand, foot to foot, perineum to crown, breastbone and back to where the legs merge, breastbone and
/// back to the crown, head to hands: fractions of the body size. Head to feet follows from foot to foot and
/// that size.
using Build = std::array<float, 8>;

inline Build build_of(const BodyCoordinates& coordinates) {
  const BodyExtremities& tips = coordinates.extremities();
  Build build{tips.hands_apart,
              tips.feet_apart,
              coordinates.trunk_m(),
              coordinates.front_to_merge_m(),
              coordinates.back_to_merge_m(),
              coordinates.from_front()[tips.head],
              coordinates.from_back()[tips.head],
              0.5F * ((*tips.from_head)[tips.hand[0]] + (*tips.from_head)[tips.hand[1]])};
  for (float& length : build) length /= coordinates.size_m();
  return build;
}

}  // namespace bodice::anatomy
