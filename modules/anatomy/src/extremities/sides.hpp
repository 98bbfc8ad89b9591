// Which side of the body is its left.
#pragma once

#include "extremities/extremities.hpp"

namespace bodice::inline v0_1::anatomy {

/// How hands and feet of the two sides are assigned.
struct Sides {
  bool a_is_left = true;
  double confidence = 0.0;  ///< 0..1
};

/// Finds the left side by the order front, outer, back, inner around each leg. On an oriented skin no pose
/// changes this order.
Sides find_sides(const engine::Context& context, const Skin& skin, const Extremities& tips);

}  // namespace bodice::anatomy
