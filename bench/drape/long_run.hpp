// A garment on a body that moves for seconds and then stands, judged in every frame by the posed skin.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "causes.hpp"
#include "moving_outfits.hpp"

namespace bench {

/// How long a body moves, and how it is simulated.
struct LongRunOptions {
  std::string motion;                 ///< name of a made motion, which loops
  double moving_s = 10.0;             ///< time in motion
  double resting_s = 1.5;             ///< time at rest after it
  double easing_s = 0.5;              ///< time from motion to rest
  bodice::tryon::DrapeOptions drape;  ///< frames, kept frames and motion are set by the run
  bool repeat = false;                ///< again with 1 and with 3 workers, to compare the hashes
};

/// What happened. Depths are of particles inside the exact posed skin.
struct LongRun {
  bodice::tryon::DrapeReport report;
  std::vector<bodice::io::GarmentTrack> garments;                ///< every tenth frame
  std::vector<std::vector<bodice::geometry::Vec3>> body_frames;  ///< the same frames
  double deepest_m = 0.0, deepest_s = 0.0;                       ///< while the body moves, and when
  int frames_over_2mm = 0;
  DeepParticles deep;       ///< what lies deep in all kept frames but the first
  double rest_m = 0.0;      ///< deepest particle of the last half second
  double drop_m = 0.0;      ///< how much lower the garment ends, against the body
  double proxy_mm = 0.0;    ///< mean of the proxy's mean errors over the kept frames
  bool same_hashes = true;  ///< for 1, 2, 3 and 7 workers; true where it was not repeated
};

LongRun run_long(const bodice::engine::Context& context, const MovingOutfit& outfit,
                 const LongRunOptions& options);

/// A contact sheet of the kept frames, from the front; false if it cannot be written.
bool write_sheet(const MovingOutfit& outfit, const LongRun& run, const std::filesystem::path& png);

}  // namespace bench
