#include "extremities/body_extremities.hpp"

namespace bodice::anatomy {

BodyEnds in_body_order(const EndPoints& ends, const Sides& sides) {
  BodyEnds body;
  body.head = ends.vertex[kHead];
  body.from_head = &ends.field[kHead];
  const std::array<End, 2> hand = sides.a_is_left ? std::array{kHandA, kHandB} : std::array{kHandB, kHandA};
  const std::array<End, 2> foot = sides.a_is_left ? std::array{kFootA, kFootB} : std::array{kFootB, kFootA};
  for (int side = 0; side < 2; ++side) {
    body.hand[side] = ends.vertex[hand[side]];
    body.foot[side] = ends.vertex[foot[side]];
    body.from_hand[side] = &ends.field[hand[side]];
    body.from_foot[side] = &ends.field[foot[side]];
  }
  body.hands_apart = ends.hands_apart();
  body.feet_apart = ends.feet_apart();
  body.head_to_feet = ends.head_to_feet();
  return body;
}

}  // namespace bodice::anatomy
