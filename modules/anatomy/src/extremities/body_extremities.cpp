#include "extremities/body_extremities.hpp"

namespace bodice::inline v0_1::anatomy {

BodyExtremities in_body_order(const Extremities& tips, const Sides& sides) {
  BodyExtremities body;
  body.head = tips.vertex[kHead];
  body.from_head = &tips.field[kHead];
  const std::array<Extremity, 2> hand =
      sides.a_is_left ? std::array{kHandA, kHandB} : std::array{kHandB, kHandA};
  const std::array<Extremity, 2> foot =
      sides.a_is_left ? std::array{kFootA, kFootB} : std::array{kFootB, kFootA};
  for (int side = 0; side < 2; ++side) {
    body.hand[side] = tips.vertex[hand[side]];
    body.foot[side] = tips.vertex[foot[side]];
    body.from_hand[side] = &tips.field[hand[side]];
    body.from_foot[side] = &tips.field[foot[side]];
  }
  body.hands_apart = tips.hands_apart();
  body.feet_apart = tips.feet_apart();
  body.head_to_feet = tips.head_to_feet();
  return body;
}

}  // namespace bodice::anatomy
