// The height of a body that need not stand.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// What shows whether a body stands.
struct Stance {
  geometry::Vec3 crown, neck, crotch, knees, ankles;  ///< the points between knees and between ankles
  std::array<geometry::Vec3, 2> toes;
};
/// The height from the lowest of the points to the crown, if the body stands and is about as tall as was
/// estimated; else the estimate. O(#points).
double stature_of(const Stance& stance, const std::vector<geometry::Vec3>& points, double estimate);

/// Lengths along the skin that the height follows where a body does not stand, in the mesh's unit: head to
/// feet, foot to foot, hand to hand, head to hands, and breastbone and back to where the legs merge.
std::array<double, 6> stature_lengths(const BodyCoordinates& coordinates);

/// The height from sole to crown; empty if the body does not stand, or is not about as tall as was estimated.
std::optional<double> standing_height(const Skin& skin, const BodyCoordinates& coordinates,
                                      const Landmarks& marks, double estimate);

/// The height of the body as if it stood, in the mesh's unit: from sole to crown if it stands, else from
/// lengths along the skin, within about 1.5 % (one deviation).
double find_stature(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks);

}  // namespace bodice::anatomy
