// What all runs of this bench have in common: their frames, and when they count.
#pragma once

#include <vector>

#include <bodice/geometry/types.hpp>

#include <bench_support/visible.hpp>

namespace bench {

inline constexpr double kFrame_s = 1.0 / 60.0;
inline constexpr int kFirstFrames = 10;  ///< a garment may take so long to come out of the body or a fold

/// The mean of the heights of the positions, meters.
inline double mean_height(const std::vector<bodice::geometry::Vec3>& positions) {
  double sum = 0.0;
  for (const bodice::geometry::Vec3& p : positions) sum += p.y();
  return sum / static_cast<double>(positions.size());
}

}  // namespace bench
