// Limbs that have grown together are parted inside the body, where it is known roughly how they lie.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <bodice/geometry/contour.hpp>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// #nodes of the grid: whether a node lies between two limbs on the outer side of the fold that they meet in.
/// An arm is parted from all else at the fold of its armpit, the legs from each other at that of the crotch.
/// What belongs to a limb is flooded from the bones of `found`, deepest nodes first, so that walls stand
/// where the body is thinnest between two of them. `depth` is the distance of each node below the skin,
/// negative outside. O(#nodes log #nodes).
std::vector<char> known_walls(const geometry::FieldGrid& depth, const Anatomy& found,
                              const std::vector<Fold>& folds);

}  // namespace bodice::anatomy
