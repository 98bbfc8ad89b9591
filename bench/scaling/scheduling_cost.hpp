#pragma once

#include <string>
#include <vector>

namespace bodice_bench {

/// The time of the engine and of raw TBB for the same work, measured in turns in one run.
struct Cost {
  std::string what, unit;
  double engine = 0.0, tbb = 0.0;  ///< median
  double engine_min = 0.0, tbb_min = 0.0;
};

/// The costs of empty tasks, of the smallest loop, of graph tasks, and of ordered reduction (same bits).
std::vector<Cost> scheduling_costs(int workers, int repeats);

}  // namespace bodice_bench
