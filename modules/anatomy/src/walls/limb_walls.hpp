// Where limbs that have grown together are parted inside the body, before any landmark is known.
#pragma once

#include <vector>

#include <bodice/geometry/contour.hpp>

namespace bodice::inline v0_1::anatomy {

/// #nodes of the grid: whether a node lies between two legs, or between an arm that hangs and what it
/// touches. `depth` is the distance of each node below the skin, negative outside. The body stands along the
/// longest axis of the grid. Limbs are lobes of the slices across it that a neck joins to others: `neck` is
/// the largest depth of a neck, as a share of the shallower lobe's. An arm that is lost in the trunk goes on
/// to the shoulder, and a hand that lies flat on a thigh down from its wrist. O(#nodes log #nodes).
std::vector<char> limb_walls(const geometry::FieldGrid& depth, double neck);

}  // namespace bodice::anatomy
