#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace bodice::inline v0_1::fitting {

/// The index of the first value within a relative 1e-4 of the largest one; the number of values if none is
/// positive. The left and the right of a body are alike: which of them is split first must depend neither on
/// the rounding of coordinates nor on the tolerance of enclosing ellipsoids.
inline std::size_t tolerant_argmax(std::span<const double> values) {
  constexpr double kTie = 1e-4;
  double most = 0.0;
  for (const double v : values) most = std::max(most, v);
  const auto is_largest = [&](double v) { return v > 0.0 && v >= (1.0 - kTie) * most; };
  return static_cast<std::size_t>(std::ranges::find_if(values, is_largest) - values.begin());
}

}  // namespace bodice::fitting
