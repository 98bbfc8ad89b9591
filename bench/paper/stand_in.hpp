// A stand-in for the paper's reference [19], Tang et al.: of it the paper says that it builds adaptive
// ellipsoids by an improved K-means and is "computationally expensive due to repeated backtracking". Nothing
// more is known here, so this is the plainest method that fits the words; its times say what skipping
// segmentation, the pruned stop and the local refit costs, and nothing about the authors' program.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

namespace paper_bench {

struct RivalFit {
  std::vector<bodice::geometry::Ellipsoid> ellipsoids;
  int backtracks = 0;  ///< splits tried and taken back
};

/// K-means over the whole skin, from one cluster: splits the worst ellipsoid along its longest axis, lets
/// K-means converge, encloses every cluster anew, and takes the split back for the next worst ellipsoid's if
/// the worst error did not fall; after `most_tries` of them it keeps the best. Ends at `count` ellipsoids.
RivalFit fit_rival(const bodice::engine::Context& context, std::span<const bodice::geometry::Vec3> skin,
                   std::size_t count, int most_tries, double min_radius_m);

/// Eq. (6): mean distance along the ray from the center between points and surface.
double radial_error(const bodice::geometry::Ellipsoid& ellipsoid,
                    std::span<const bodice::geometry::Vec3> points);

inline constexpr int kMostTries = 8;

}  // namespace paper_bench
