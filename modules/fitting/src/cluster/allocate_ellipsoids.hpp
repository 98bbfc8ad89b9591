// How many ellipsoids each region gets before any is fitted, so that the regions need not wait for each
// other.
#pragma once

#include <vector>

#include "cluster/refinement.hpp"
#include "cluster/thresholds.hpp"

namespace bodice::fitting {

/// Shares `count` ellipsoids out (at least its seeds to a region): a rehearsal of the bisecting refinement on
/// at most 2048 points, with the principal axes of each cluster instead of its enclosing ellipsoid and
/// without K-means, in which the worst ellipsoid of all regions is split again and again. Well under a
/// millisecond.
std::vector<int> allocate_ellipsoids(const engine::Context& context, const Items& items,
                                     const std::vector<Region>& regions, int count);

}  // namespace bodice::fitting
