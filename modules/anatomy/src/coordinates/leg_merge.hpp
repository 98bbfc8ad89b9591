// Where the legs join, read from the mesh alone.
#pragma once

#include "coordinates/midline.hpp"

namespace bodice::inline v0_1::anatomy {

/// The point where the growing discs around both feet first touch: below it the isolines of the distance from
/// the nearer foot are one loop a leg, above it they have merged. The paper's perineum.
struct LegMerge {
  SkinPoint at;
  float distance = 0.0F;  ///< from either foot, meters
};

/// at.found() is false where no path leads from foot to foot. O(#E).
LegMerge find_leg_merge(const Skin& skin, const BodyExtremities& tips);

}  // namespace bodice::anatomy
