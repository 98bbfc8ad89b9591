#pragma once

#include "extremities/sides.hpp"

namespace bodice::anatomy {

/// The ends in the body's own order: index 0 left, 1 right.
struct BodyExtremities {
  geometry::Index head = 0;
  std::array<geometry::Index, 2> hand{}, foot{};
  const geodesic::Field* from_head = nullptr;
  std::array<const geodesic::Field*, 2> from_hand{}, from_foot{};
  float hands_apart = 0.0F, feet_apart = 0.0F, head_to_feet = 0.0F;  ///< meters along the skin
};

/// Refers to the fields of `ends`.
BodyExtremities in_body_order(const Extremities& tips, const Sides& sides);

}  // namespace bodice::anatomy
