// One named task for each region of the body: regions are fitted in parallel and published in their order.
//
//     share ellipsoids --+--> refine torso    --> region published
//                        +--> refine thigh_l  --> region published
//                        +--> ...
#pragma once

#include <functional>
#include <string_view>

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"

namespace bodice::inline v0_1::fitting {

/// The result of a region's task.
struct FittedRegion {
  std::vector<proxy::ProxyEllipsoid> ellipsoids;
  std::vector<double> error_m;  ///< E_j of each ellipsoid; empty for tiers without clusters
};

/// What the tasks of all regions do.
struct RegionTasks {
  std::string_view verb;  ///< tasks are named "<verb> <region>"
  /// Returns the number of ellipsoids of each region; it runs as a task of its own.
  std::function<std::vector<int>(const engine::Context&)> share;
  std::function<FittedRegion(const engine::Context&, const Region&, int count)> fit;
  std::uint32_t parts = kAllParts;  ///< a region without any of these parts has no task
  std::function<void(const FittedPart&)>
      on_part;  ///< may be empty; called for one region at a time, in order
};

/// Whether the region has one of the parts.
inline bool wanted(const Region& region, std::uint32_t parts) {
  return (region.parts & parts) != 0;
}

/// Runs the tasks, the largest regions first. Returns #regions results in the order of the regions, empty
/// where a region has no task. Fails with kCanceled.
engine::Result<std::vector<FittedRegion>> run_region_tasks(const engine::Context& context,
                                                           const std::vector<Region>& regions,
                                                           const RegionTasks& tasks);

}  // namespace bodice::fitting
