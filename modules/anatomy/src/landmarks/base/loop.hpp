// A closed curve along the skin.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::anatomy {

/// A closed curve around the neck, the trunk or a limb.
struct Loop {
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< centroid of the curve
  geometry::Index vertex = geometry::kNoIndex;     ///< a vertex of the skin beside the curve
  double girth_m = 0.0;
  double confidence = 0.0;                    ///< 1 for a closed curve, 0.5 for one that a hole cuts
  float level_m = 0.0F;                       ///< mean distance of the curve from the end of its limb
  float from_front = 0.0F, from_back = 0.0F;  ///< least distance on it from breastbone and back, meters

  bool found() const { return vertex != geometry::kNoIndex; }
};

}  // namespace bodice::anatomy
