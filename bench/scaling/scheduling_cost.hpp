#pragma once

#include <string>
#include <vector>

namespace bodice_bench {

/// The engine beside raw TBB doing the same, in turns in one run.
struct Cost {
  std::string what, unit;
  double engine = 0.0, tbb = 0.0;  ///< median
  double engine_min = 0.0, tbb_min = 0.0;
};

/// Empty tasks, the smallest loop, graph tasks, and what ordered (same bits) reduction costs.
std::vector<Cost> scheduling_costs(int workers, int repeats);

}  // namespace bodice_bench
