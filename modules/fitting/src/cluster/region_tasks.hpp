// One named task a region of the body: parts are fitted beside one another, and handed on as they end.
//
//     share ellipsoids --+--> refine torso    --> part handed on
//                        +--> refine thigh_l  --> part handed on
//                        +--> ...
#pragma once

#include <functional>
#include <string_view>

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"

namespace bodice::fitting {

/// What a region's task leaves.
struct FittedRegion {
  std::vector<proxy::ProxyEllipsoid> ellipsoids;
  std::vector<double> error_m;  ///< E_j of each, where the tier has it
};

struct RegionTasks {
  std::string_view verb;  ///< tasks are named "<verb> <region>"
  /// Ellipsoids for each region, decided in a task of its own.
  std::function<std::vector<int>(const engine::Context&)> share;
  std::function<FittedRegion(const engine::Context&, const Region&, int count)> fit;
  std::uint32_t parts = kAllParts;                 ///< regions that have none of these have no task
  std::function<void(const FittedPart&)> on_part;  ///< may be empty; called one at a time, in order
};

inline bool wanted(const Region& region, std::uint32_t parts) {
  return (region.parts & parts) != 0;
}

/// Runs the tasks, the largest regions first; #regions results in the order of the regions, empty where there
/// is no task. Fails with kCanceled.
engine::Result<std::vector<FittedRegion>> run_region_tasks(const engine::Context& context,
                                                           const std::vector<Region>& regions,
                                                           const RegionTasks& tasks);

}  // namespace bodice::fitting
