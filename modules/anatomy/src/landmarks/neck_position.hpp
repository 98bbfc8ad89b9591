#pragma once

#include "landmarks/landmarks.hpp"

namespace bodice::anatomy {

/// Where the neck's joint lies by what the neck and the trunk measure: heavy necks and shoulders hide it
/// below their flesh. The first answer on a fused skin, or where no neck was found. Precondition: the first
/// answer and the armpits are found. O(#V + #F).
geometry::Vec3 neck_by_measures(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks);

}  // namespace bodice::anatomy
