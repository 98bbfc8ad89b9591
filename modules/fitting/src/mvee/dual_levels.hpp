// How far each point is from where the dual would have it: the inner loop of enclosing ellipsoids, alone in
// its file so that it can be compiled for several instruction sets.
#pragma once

#include <cstddef>

namespace bodice::fitting {

/// Rows map (x, y, z, 1).
struct LiftedMap {
  double row[4][4] = {};
};

/// level[i] = |map (x[i], y[i], z[i], 1)|^2 for n points. Nothing aliases.
void dual_levels(const LiftedMap& map, std::size_t n, const double* x, const double* y, const double* z,
                 double* level);

}  // namespace bodice::fitting
