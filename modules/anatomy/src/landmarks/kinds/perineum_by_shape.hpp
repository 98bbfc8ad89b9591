#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// The perineum by the shape of the line between the legs. Distances along the skin place it well where
/// builds differ little; on heavy thighs and seats they are some 3 % of the body size off along that line,
/// while the line itself shows where the floor of the trunk turns up to the front. The first estimate where
/// the line is cut. Precondition: neck, knees and the first estimate are found. O(#V + #F).
geometry::Vec3 perineum_by_shape(const LandmarkInput& input, const Landmarks& marks);

}  // namespace bodice::anatomy
