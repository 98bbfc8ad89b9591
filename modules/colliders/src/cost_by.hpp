// The cost of a collider by the function that gives a point's signed distance to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <bodice/colliders/reduce.hpp>
#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::colliders {

using Weighted = std::vector<std::pair<double, double>>;  // distance, area

inline SurfaceError error_of(Weighted& samples) {
  SurfaceError error;
  std::ranges::sort(samples);
  for (const auto& [distance, area] : samples) {
    error.mean_m += distance * area, error.area_m2 += area;
    error.worst_m = distance;
  }
  if (!(error.area_m2 > 0.0)) return error;
  error.mean_m /= error.area_m2;
  double below = 0.0;
  for (const auto& [distance, area] : samples) {
    below += area, error.p95_m = distance;
    if (below >= 0.95 * error.area_m2) break;
  }
  return error;
}

/// Costs by the function that gives a point's signed distance.
template <class Distance>
ReductionCost cost_by(const engine::Context& context, const proxy::BodyProxy& proxy, const SkinPoints& points,
                      Distance distance) {
  std::vector<double> gap(points.position.size());
  engine::parallel_for(context, gap.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) gap[p] = std::abs(distance(points.position[p]));
  });
  Weighted whole;
  std::array<Weighted, body::kAllPartCount> of_part;
  for (std::size_t p = 0; p < gap.size(); ++p) {
    if (!(points.area[p] > 0.0)) continue;
    whole.emplace_back(gap[p], points.area[p]);
    of_part[static_cast<std::size_t>(proxy.ellipsoids()[points.owner[p]].part)].push_back(whole.back());
  }
  ReductionCost cost;
  cost.whole = error_of(whole);
  for (std::size_t i = 0; i < of_part.size(); ++i) cost.of_part[i] = error_of(of_part[i]);
  return cost;
}

}  // namespace bodice::colliders
