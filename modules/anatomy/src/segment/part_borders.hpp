// The borders of the parts, as they run on bodies of one build.
#pragma once

#include "coordinates/border.hpp"
#include "coordinates/build.hpp"

namespace bodice::inline v0_1::anatomy {

/// The borders between parts, each as it runs on one body.
struct PartBorders {
  Border neck, shoulder, elbow, knee, hip, waist, chest;
};

/// A belly, heavy thighs and thick shoulders lengthen some paths along the skin and not others, so that one
/// sum of distances is level with a joint on slim bodies and far from it on heavy ones. Therefore the weights
/// of each border but the elbow's follow eight lengths of the whole body. Landmarks read borders of their own
/// (coordinates/border.hpp), to which their corrections were fitted. Weights follow a measure as far as
/// bodies were known; beyond that, the neck's border is the one of landmarks. O(1).
PartBorders part_borders(const Build& build);

}  // namespace bodice::anatomy
