// The lengths of a body, by which landmarks are corrected.
#pragma once

#include "coordinates/body_coordinates.hpp"

namespace bodice::inline v0_1::anatomy {

/// Hand to hand, head to feet, head to hands, breastbone to crown, back to crown: fractions of the body size.
using BodyLengths = std::array<double, 5>;

/// No calibration body needs a correction by its lengths that is longer; beyond, the lengths are not those of
/// a body. A fraction of the body size.
inline constexpr double kMostByLengths = 0.05;

inline BodyLengths body_lengths(const BodyCoordinates& coordinates) {
  const BodyExtremities& tips = coordinates.extremities();
  const auto of_size = [&](float length_m) {
    return static_cast<double>(length_m) / static_cast<double>(coordinates.size_m());
  };
  return {of_size(tips.hands_apart), of_size(tips.head_to_feet),
          of_size(0.5F * ((*tips.from_head)[tips.hand[0]] + (*tips.from_head)[tips.hand[1]])),
          of_size(coordinates.from_front()[tips.head]), of_size(coordinates.from_back()[tips.head])};
}

}  // namespace bodice::anatomy
