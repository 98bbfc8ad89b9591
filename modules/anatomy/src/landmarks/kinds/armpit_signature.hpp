// The armpit by its signature in the body's coordinates.
#pragma once

#include <array>

#include "coordinates/body_coordinates.hpp"

namespace bodice::inline v0_1::anatomy {

/// The vertex with the signature nearest to that of an armpit, and the evidence for it.
struct ArmpitSignature {
  geometry::Vec3 position = geometry::Vec3::Zero();  ///< weighted mean of the vertices around it, meters
  geometry::Index vertex = geometry::kNoIndex;
  float mahalanobis = 0.0F;  ///< Mahalanobis distance of its features, in deviations among bodies
  float margin = 0.0F;       ///< by how much the Mahalanobis distance of the best vertex elsewhere is larger
};

/// Half the girth of the chest on one side, as a fraction of the body size: the shortest path along the skin
/// from the front of the midline under the arm to its back. O(#V).
float half_chest(const BodyCoordinates& coordinates, int side);

/// Whether a vertex lies where the armpit of a side is searched for.
bool may_be_armpit(const BodyCoordinates& coordinates, std::size_t vertex, int side);

/// The 14 features of the armpit's signature at a vertex, and the 6 measures of the body that predict them.
/// kArmpit lists both in their order.
std::array<float, 14> armpit_features(const BodyCoordinates& coordinates, std::size_t vertex, int side,
                                      float half_chest);
std::array<float, 6> armpit_measures(const BodyCoordinates& coordinates, float half_chest);

/// Finds the armpit of a side (0: left, 1: right) by its signature. O(#V).
ArmpitSignature find_armpit(const engine::Context& context, const Skin& skin,
                            const BodyCoordinates& coordinates, int side);

}  // namespace bodice::anatomy
