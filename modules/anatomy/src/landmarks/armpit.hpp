// The fold behind the arm where it leaves the trunk.
#pragma once

#include "coordinates/body_coordinates.hpp"

namespace bodice::anatomy {

/// A place on the skin that is told by its coordinates.
struct SignedPlace {
  geometry::Vec3 position = geometry::Vec3::Zero();
  geometry::Index vertex = geometry::kNoIndex;
  float misfit = 0.0F;  ///< of its coordinates, in deviations among bodies
  float lead = 0.0F;    ///< how much more the coordinates of the best place elsewhere are off
};

/// side 0: left, 1: right. O(#V).
SignedPlace find_armpit(const engine::Context& context, const Skin& skin, const BodyCoordinates& coordinates,
                        int side);

}  // namespace bodice::anatomy
