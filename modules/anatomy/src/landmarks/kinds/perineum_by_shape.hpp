#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// The perineum, corrected by the shape of the line between the legs. Distances along the skin give it well
/// for usual builds. On heavy thighs and seats they are wrong by some 3 % of the body size along that line,
/// which itself shows where the floor of the trunk rises to the front. Returns the first estimate where the
/// line is interrupted. Precondition: neck, knees and the first estimate are found. O(#V + #F).
geometry::Vec3 perineum_by_shape(const LandmarkInput& input, const Landmarks& marks);

}  // namespace bodice::anatomy
