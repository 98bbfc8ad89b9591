// The loop along which a border runs around a limb.
#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Which loop of a border is meant.
struct BorderOfLimb {
  const Border& border;
  Coordinate end;       ///< distance from the end of the limb: kFromHead, kOwnHand or kOwnFoot
  float reach;          ///< beyond this distance from that end, in its units, the border's sign means nothing
  float beyond = 0.0F;  ///< score by which the loop lies beyond the border, away from the end
};

/// The longest zero line of the border near the limb's end. Not found where there is none. O(#V + #F).
Loop border_loop(const Skin& skin, const BodyCoordinates& coordinates, const BorderOfLimb& wanted, int side);

}  // namespace bodice::anatomy
