// The armpit by its signature in the body's coordinates.
#pragma once

#include <array>

#include "coordinates/body_coordinates.hpp"

namespace bodice::inline v0_1::anatomy {

/// The vertex with the signature nearest to an armpit's, and how clearly it is the nearest.
struct ArmpitSignature {
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< between the vertices around it
  geometry::Index vertex = geometry::kNoIndex;
  float mahalanobis = 0.0F;  ///< of its coordinates, in deviations among bodies
  float margin = 0.0F;       ///< how many deviations more the best vertex elsewhere is off
};

/// Half the girth of the chest on one side: the shortest path from the midline's front to its back under the
/// arm, as a fraction of the body size. O(#V).
float half_chest(const BodyCoordinates& coordinates, int side);

/// Whether a vertex lies where the armpit of a side is searched for.
bool may_be_armpit(const BodyCoordinates& coordinates, std::size_t vertex, int side);

/// What the armpit's signature reads at a vertex, and which measures of the body it follows.
std::array<float, 14> armpit_features(const BodyCoordinates& coordinates, std::size_t vertex, int side,
                                      float half_chest);
std::array<float, 6> armpit_measures(const BodyCoordinates& coordinates, float half_chest);

/// side 0: left, 1: right. O(#V).
ArmpitSignature find_armpit(const engine::Context& context, const Skin& skin,
                            const BodyCoordinates& coordinates, int side);

}  // namespace bodice::anatomy
