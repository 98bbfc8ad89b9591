// The extremities by the body's own left and right.
#pragma once

#include "extremities/sides.hpp"

namespace bodice::inline v0_1::anatomy {

/// Head, hands and feet; index 0 is the body's left, 1 its right.
struct BodyExtremities {
  geometry::Index head = 0;
  std::array<geometry::Index, 2> hand{}, foot{};
  const geodesic::Field* from_head = nullptr;
  std::array<const geodesic::Field*, 2> from_hand{}, from_foot{};
  float hands_apart = 0.0F, feet_apart = 0.0F, head_to_feet = 0.0F;  ///< meters along the skin
};

/// The extremities by side; `sides` states which of A and B is left. The result refers to the fields of
/// `tips`.
BodyExtremities in_body_order(const Extremities& tips, const Sides& sides);

}  // namespace bodice::anatomy
