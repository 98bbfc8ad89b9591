// Divides a skin into the 15 parts, by body coordinates.
#pragma once

#include <bodice/body/part.hpp>

#include "coordinates/body_coordinates.hpp"

namespace bodice::inline v0_1::anatomy {

/// Every vertex gets a part; each part is one patch of the body. Pieces other than the body take the part of
/// the closest point of the skin. O(#V log #V).
std::vector<body::Part> segment(const engine::Context& context, const Skin& skin,
                                const BodyCoordinates& coordinates);

}  // namespace bodice::anatomy
