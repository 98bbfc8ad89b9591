// Points as loops in vector code take them.
#pragma once

#include <cstddef>

namespace bodice::inline v0_1::fitting {

/// Points as structure of arrays.
struct PointArrays {
  std::size_t count = 0;  ///< of points; the arrays may be longer
  const float *x = nullptr, *y = nullptr, *z = nullptr;
};

}  // namespace bodice::fitting
