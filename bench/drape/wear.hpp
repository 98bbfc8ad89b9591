#pragma once

#include "outfits.hpp"

namespace bench {

/// How a garment is worn, and for how long.
struct WearOptions {
  int windy_frames = 300;
  int calm_frames = 300;  ///< frames without wind, after the windy ones, in which cloth comes to rest
  bodice::cloth::SolverOptions solver;
  bodice::cloth::Fabric fabric;
  double turn_rad_s = 0.0;  ///< speed at which the body turns about the vertical through its middle
  bool trace = false;       ///< a line every thirty frames
};

/// Measurements of a garment on its body; every depth is by the exact signed distance to the skin.
struct Wear {
  std::size_t particles = 0, held = 0, asleep = 0;
  double frame_ms_median = 0.0, frame_ms_p99 = 0.0, frame_ms_max = 0.0;
  double stretch_p95 = 0.0, stretch_max = 0.0;  ///< at the end of the windy frames
  double settled_deepest_m = 0.0;               ///< in any frame after the first ten
  double end_deepest_m = 0.0;
  double drop_m = 0.0;           ///< loss of the garment's mean height
  double windy_speed_m_s = 0.0;  ///< median, last windy frame
  double rest_speed_m_s = 0.0;   ///< median, last calm frame
  double behind_rad = 0.0;       ///< angle by which the garment turned less than its body
  double pierced_share = 0.0;    ///< share of the cloth's area inside the skin, at the end
  bool finite = true;
  std::vector<bodice::geometry::Vec3> end;  ///< #V after the windy frames
};

/// Drapes the garment on the body and measures it.
Wear wear(const bodice::engine::Context& context, const Body& body, const bodice::tryon::WornGarment& garment,
          const WearOptions& options);

}  // namespace bench
