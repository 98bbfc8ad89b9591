#pragma once

#include "landmarks/base/correction.hpp"
#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// The perineum by where the thighs point and by how the trunk is built: a leg that is drawn up alone takes
/// the line between the legs along, to its own side and backwards, the more so the heavier the thighs. The
/// first estimate on a skin that is fused. Precondition: the first estimate and all other landmarks are
/// found. O(#V).
Corrected perineum_by_legs(const LandmarkInput& input, const Landmarks& marks);

}  // namespace bodice::anatomy
