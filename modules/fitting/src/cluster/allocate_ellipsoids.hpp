// How many ellipsoids each region gets. This is decided before any is fitted, so that no region waits for
// another.
#pragma once

#include <vector>

#include "cluster/refinement.hpp"
#include "cluster/thresholds.hpp"

namespace bodice::inline v0_1::fitting {

/// Allocates `count` ellipsoids to the regions; each gets at least as many as it has seeds. A cheap stand-in
/// for the bisecting refinement decides: on at most 2048 points, with principal axes in place of enclosing
/// ellipsoids and without K-means, it splits the cluster with the largest error of all regions again and
/// again. Well under a millisecond.
std::vector<int> allocate_ellipsoids(const engine::Context& context, const Items& items,
                                     const std::vector<Region>& regions, int count);

}  // namespace bodice::fitting
