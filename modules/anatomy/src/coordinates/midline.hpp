// The middle of the body: where left and right are equally far.
#pragma once

#include "extremities/body_extremities.hpp"

namespace bodice::inline v0_1::anatomy {

/// Where the midline of the trunk passes between the hands, in front and behind.
struct Midline {
  SkinPoint front;  ///< of the chest: the middle of the path from hand to hand over the breastbone
  SkinPoint back;   ///< the same over the back
};

Midline find_midline(const Skin& skin, const BodyExtremities& tips);

/// Distances from a point on an edge.
geodesic::Field distances_from(const Skin& skin, const SkinPoint& point);

}  // namespace bodice::anatomy
