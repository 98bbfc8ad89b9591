// Ends and joints of limbs once more.
#pragma once

#include "check/cross_check.hpp"

namespace bodice::anatomy {

/// Fills in the second ways of crown, fingertips, toes, elbows and knees: ends by their distance from the
/// perineum, joints by the bend of the limb. O(#V + #F).
void cross_check_positions(const engine::Context& context, const Skin& skin,
                           const BodyCoordinates& coordinates, const Landmarks& marks, CrossCheck& second);

}  // namespace bodice::anatomy
