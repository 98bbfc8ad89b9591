#pragma once

#include "stage.hpp"

namespace bodice_bench {

/// The limits that a stage's blocks set to its speed-up; other programs on the machine do not change them.
struct WorkSpan {
  double work_ms = 0.0;  ///< processor time of one serial run
  double span_ms = 0.0;  ///< the longest chain of parts that cannot run in parallel
  /// The least speed-up that a scheduler which never idles beside ready blocks reaches with n workers.
  double speed_up(int workers) const { return work_ms / (span_ms + (work_ms - span_ms) / workers); }
};

/// Runs `work` once on this thread and times its blocks by the thread's own processor clock.
/// Based on: Richard P. Brent. The Parallel Evaluation of General Arithmetic Expressions. 1974. - T_n <= span
/// + (work - span) / n.
WorkSpan measure_work_span(const Work& work, int pretended_workers);

}  // namespace bodice_bench
