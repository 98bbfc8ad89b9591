// What may be wrong with a body or with what was understood of it.
#pragma once

#include <bodice/engine/result.hpp>

#include <bodice/body/proportions.hpp>

#include "check/cross_check.hpp"

namespace bodice::anatomy {

std::vector<engine::Warning> diagnose(const Skin& skin, const Extremities& found, const Sides& sides,
                                      const BodyCoordinates& coordinates, const Landmarks& marks,
                                      const CrossCheck& second, const body::ProportionProfile& profile,
                                      double stature);

}  // namespace bodice::anatomy
