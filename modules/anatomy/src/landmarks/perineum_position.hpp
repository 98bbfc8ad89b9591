#pragma once

#include "landmarks/landmarks.hpp"

namespace bodice::anatomy {

/// Where the perineum lies by the shape of the line between the legs. Distances along the skin tell where
/// builds differ little; on heavy thighs and seats they are some 3 % of the size off along that line, while
/// the line itself shows where the floor of the trunk turns up to the front. The first answer where the line
/// is cut. Precondition: neck, knees and the first answer are found. O(#V + #F).
geometry::Vec3 perineum_by_shape(const Skin& skin, const BodyCoordinates& coordinates,
                                 const Landmarks& marks);

}  // namespace bodice::anatomy
