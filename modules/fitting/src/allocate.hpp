// Spending an ellipsoid budget over the regions: the automatic choice of the paper's thresholds mu.
#pragma once

#include <memory>

#include <bodice/engine/context.hpp>

#include "refine.hpp"

namespace bodice::fitting {

struct Thresholds {
  double torso_m = 0.0, limbs_m = 0.0;  ///< 0: no threshold, the count decides
};

struct Allocation {
  std::vector<Refinement> regions;
  Thresholds in_force;  ///< the worst E that is left in torso and limbs
  bool reached = true;  ///< false: the thresholds were not reached (count or size of clusters)
  std::size_t count() const;
  std::vector<Cluster> clusters() const;
};

/// The torso may be this much worse than the limbs: its cross-sections are three times wider.
inline constexpr double kTorsoToLimbs = 1.6;

/// Splits the worst ellipsoid (its E relative to its class's threshold) until every threshold is met or
/// `max_count` is reached. Regions far from the limit are refined in parallel.
Allocation allocate(const engine::Context& context, const Items& items, std::vector<Region> regions,
                    const RefineOptions& options, const Thresholds& thresholds, std::size_t max_count);

}  // namespace bodice::fitting
