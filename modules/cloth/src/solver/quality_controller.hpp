// The number of substeps of a frame, and the quality that frames drop to stay within their budget.
#pragma once

#include <cstdint>

#include <bodice/cloth/solver.hpp>

namespace bodice::inline v0_1::cloth {

/// The number and length of a frame's substeps.
struct Plan {
  int substeps = 0;
  float substep_s = 0.0f;
  double simulated_s = 0.0;
  double travel_m = 0.0;     ///< travel of the fastest particle in the frame if it falls
  std::uint32_t limits = 0;  ///< FrameLimit bits
};

/// The motion and stretch of the cloth by which the substeps of a frame are planned.
struct Pace {
  double speed_m_s = 0.0;     ///< the speed that all but a few particles keep
  double max_travel_m = 1.0;  ///< the most that a substep may move a particle
  bool stretched = false;     ///< whether the body stretches cloth far beyond the limit of its fabric
};

/// Plans a frame of `dt_s`; `level` is that of the budget.
Plan plan_frame(const SolverOptions& options, double dt_s, const Pace& pace, int level);

/// The level of quality. At 0 nothing is dropped; each further level adds one of the budget's FrameLimit
/// bits.
struct Budget {
  int level = 0;
  int good_frames = 0;  ///< consecutive frames at less than half of the budget
};

/// Lowers the quality by a level after a frame over the budget, and raises it by a level after kGoodFrames
/// frames at less than half of the budget.
void adjust_quality(const SolverOptions& options, double frame_us, Budget& budget);

}  // namespace bodice::cloth
