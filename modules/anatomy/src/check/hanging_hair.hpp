// Hair that hangs down behind the neck.
#pragma once

#include "coordinates/body_coordinates.hpp"
#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Whether something covers the nape: its outline has no hollow between head and back, and what lies behind
/// the neck is as wide as hair. O(#F). Precondition: the head has a profile.
bool covers_nape(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks);

}  // namespace bodice::anatomy
