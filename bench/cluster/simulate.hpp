// A batch on many nodes, simulated job by job: shards, slow nodes, lost nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cluster {

/// The nodes and what happens to them.
struct Model {
  std::size_t nodes = 1;
  int cores = 16;            ///< jobs side by side on a node
  std::size_t shards = 1;    ///< tasks of the array
  double start_s = 2.0;      ///< from a free node to the first job of a task
  double slow_share = 0.0;   ///< share of the nodes that are slow
  double slow_factor = 3.0;  ///< how much longer jobs take on a slow node
  double hung_share = 0.0;   ///< share of the jobs that hang until their timeout
  double timeout_s = 600.0;
  double hours_to_loss = 0.0;  ///< mean time until a node is lost, exponential; 0: never
  double repair_s = 1800.0;    ///< until it is back
  double notice_s = 300.0;     ///< until the scheduler gives its task to another node
  std::uint64_t seed = 1;
};

struct Outcome {
  double makespan_s = 0.0;    ///< until the last result
  double busy_s = 0.0;        ///< seconds of cores for results
  double wasted_s = 0.0;      ///< seconds of cores for jobs that were lost unfinished
  std::size_t losses = 0;     ///< times that a node with work was lost
  std::size_t most_seen = 0;  ///< times that any one job began
};

/// Runs `jobs` jobs, each with a time drawn from `seconds`: the same for each model. A task that is lost
/// begins again on another node without the jobs that have a result.
Outcome simulate(const Model& model, const std::vector<double>& seconds, std::size_t jobs);

/// What no number of nodes goes below: all work spread evenly, and the longest job.
double least_makespan_s(const Model& model, const std::vector<double>& seconds, std::size_t jobs);

}  // namespace cluster
