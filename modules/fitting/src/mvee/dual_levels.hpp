// The dual's measure of every point: the inner loop of enclosing ellipsoids, alone in its file so that it can
// be compiled for several instruction sets.
#pragma once

#include <cstddef>

namespace bodice::inline v0_1::fitting {

/// A linear map of lifted points (x, y, z, 1).
struct LiftedMap {
  double row[4][4] = {};
};

/// Writes level[i] = |map (x[i], y[i], z[i], 1)|^2 for n points. No arrays overlap.
void dual_levels(const LiftedMap& map, std::size_t n, const double* x, const double* y, const double* z,
                 double* level);

}  // namespace bodice::fitting
