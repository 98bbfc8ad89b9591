// The lengths of a body, as what shifts a place from where a table of other bodies puts it.
#pragma once

#include <algorithm>
#include <cmath>

#include "coordinates/body_coordinates.hpp"
#include "skin/linear_form.hpp"

namespace bodice::anatomy {

/// Hand to hand, head to feet, head to hands, breastbone to crown, back to crown; of the size.
using BodyLengths = std::array<double, 5>;

/// How far a place lies beyond its first answer in one direction, of the size: a constant, then what each
/// length of the body counts. Fitted by least fourth powers of the error, in units of its bar, to the
/// calibration bodies and to made ones; errors are told with each build left out in turn.
template <std::size_t N>
struct Shift {
  LinearForm<N> form;

  /// No body needs more; beyond, the lengths are not those of a body.
  static constexpr double kMost = 0.05;

  double operator()(const std::array<double, N>& lengths) const {
    const double sum = form(lengths);
    return std::isfinite(sum) ? std::clamp(sum, -kMost, kMost) : 0.0;
  }
};

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
