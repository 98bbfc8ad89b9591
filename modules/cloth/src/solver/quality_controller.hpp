// How many substeps a frame gets, and what it does without when frames are over their budget.
#pragma once

#include <cstdint>

#include <bodice/cloth/solver.hpp>

namespace bodice::cloth {

struct Plan {
  int substeps = 0;
  float substep_s = 0.0f;
  double simulated_s = 0.0;
  double travel_m = 0.0;     ///< of the fastest, falling, in the frame
  std::uint32_t limits = 0;  ///< FrameLimit bits
};

/// `top_speed_m_s` of the particles now, `max_travel_m` a substep may move them, `level` of degradation.
Plan plan_frame(const SolverOptions& options, double dt_s, double top_speed_m_s, double max_travel_m,
                int level);

/// Levels of degradation; 0: none, each adds one of the budget's bits.
struct Budget {
  int level = 0;
  int good_frames = 0;
};

/// One level down after a frame over the budget, one up after a second of frames at half of it.
void learn(const SolverOptions& options, double frame_us, Budget& budget);

}  // namespace bodice::cloth
