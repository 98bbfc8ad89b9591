// The armpit by its signature in the body's coordinates.
#pragma once

#include "coordinates/body_coordinates.hpp"

namespace bodice::anatomy {

/// The vertex with the signature nearest to an armpit's, and how clearly it is the nearest.
struct ArmpitSignature {
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< between the vertices around it
  geometry::Index vertex = geometry::kNoIndex;
  float mahalanobis = 0.0F;  ///< of its coordinates, in deviations among bodies
  float margin = 0.0F;       ///< how many deviations more the best vertex elsewhere is off
};

/// side 0: left, 1: right. O(#V).
ArmpitSignature find_armpit(const engine::Context& context, const Skin& skin,
                            const BodyCoordinates& coordinates, int side);

}  // namespace bodice::anatomy
