// The inner loop of K-means, alone in its file so that it can be compiled for several instruction sets.
#pragma once

#include <cstdint>
#include <span>

#include "base/point_arrays.hpp"

namespace bodice::inline v0_1::fitting {

/// Finds, for each point, the squared distance to the nearest of the centers that `candidates` lists,
/// ascending, and that center's index, the lowest one on a tie. `centers_xyz` has all centers, three floats
/// each. `squared_distance` and `nearest`, one a point, overlap no other array.
void nearest_centers(const PointArrays& points, std::span<const std::uint32_t> candidates,
                     const float* centers_xyz, float* squared_distance, std::uint32_t* nearest);

}  // namespace bodice::fitting
