// A stand-in for the paper's reference [19], Tang et al. According to the paper, [19] builds adaptive
// ellipsoids by an improved K-means and is "computationally expensive due to repeated backtracking". Nothing
// more is known here, so this is the plainest method that fits the words. Its times show the cost of leaving
// out segmentation, the pruned stop and the local refit; they are no times of the authors' program.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

namespace paper_bench {

/// The result of the stand-in.
struct StandInFit {
  std::vector<bodice::geometry::Ellipsoid> ellipsoids;
  int backtracks = 0;  ///< splits that were tried and taken back
};

/// K-means over the whole skin, from one cluster to `count`. Each step splits the worst ellipsoid along its
/// longest axis, lets K-means converge and encloses every cluster anew. If the worst error did not fall, the
/// step takes the split back and splits the next worst ellipsoid; after `most_tries` it keeps the best try.
StandInFit fit_stand_in(const bodice::engine::Context& context, std::span<const bodice::geometry::Vec3> skin,
                        std::size_t count, int most_tries, double min_radius_m);

/// Eq. (6): the mean distance between the points and the ellipsoid's surface, along rays from the center.
double radial_error(const bodice::geometry::Ellipsoid& ellipsoid,
                    std::span<const bodice::geometry::Vec3> points);

inline constexpr int kMostTries = 8;

}  // namespace paper_bench
