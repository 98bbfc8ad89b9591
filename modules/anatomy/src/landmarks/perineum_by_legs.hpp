#pragma once

#include "landmarks/landmarks.hpp"

namespace bodice::anatomy {

struct MovedPerineum {
  geometry::Vec3 place;
  double wanted = 0.0;  ///< how far it would be moved without a limit, of the size
};

/// Where the perineum lies by where the thighs point and by how the trunk is built: a leg that is drawn up
/// alone takes the line between the legs along, to its own side and backwards, the more so the heavier the
/// thighs. The first answer on a skin that is fused. Precondition: the first answer and all other places are
/// found. O(#V).
MovedPerineum perineum_by_legs(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks);

}  // namespace bodice::anatomy
