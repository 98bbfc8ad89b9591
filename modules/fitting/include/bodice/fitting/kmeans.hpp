// K-means with the paper's pruned stop.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::fitting {

using geometry::Index;
using geometry::Vec3;

/// When K-means stops.
struct KMeansOptions {
  double sigma_m = 0.0;  ///< eq. (7): it stops when no center moved farther than this
  int max_iterations = 50;
};

/// Points assigned to their nearest centers.
struct Clusters {
  std::vector<Index> of_point;  ///< #points, index of the nearest center (the lowest one on a tie);
                                ///< kNoIndex for a point with NaN or Inf, which moves no center
  std::vector<Vec3> centers;    ///< as many as were given; a center without points does not move
  int iterations = 0;
};

/// Lloyd's iterations from the given centers. `weights` is empty or has one for each point. Deterministic for
/// any worker count; distances are compared in float relative to the first point. O(#points #centers) an
/// iteration. Based on: Stuart P. Lloyd. Least squares quantization in PCM. 1982.
Clusters kmeans(const engine::Context& context, std::span<const Vec3> points, std::span<const double> weights,
                std::vector<Vec3> centers, const KMeansOptions& options);

}  // namespace bodice::fitting
