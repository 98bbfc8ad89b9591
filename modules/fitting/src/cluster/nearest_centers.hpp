// The inner loop of K-means, alone in its file so that it can be compiled for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bodice::inline v0_1::fitting {

/// Finds, for each of n points (structure of arrays), the squared distance to the nearest of the `count`
/// centers that `which` lists (ascending), and that center's index, the lowest one on a tie. No arrays
/// overlap.
void nearest_centers(std::size_t n, const float* x, const float* y, const float* z, std::size_t count,
                     const std::uint32_t* which, const float* centers_xyz, float* distance,
                     std::uint32_t* nearest);

}  // namespace bodice::fitting
