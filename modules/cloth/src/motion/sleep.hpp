// Sleep: particles that hardly move for half a second are stopped, so that a garment at rest does not move at
// all. Particles that only tremble are stopped as well: with few substeps, the errors that sweeps leave can
// swing a fold forever.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "garment/topology.hpp"

namespace bodice::inline v0_1::cloth {

/// How long each particle has been quiet.
struct Sleep {
  std::vector<float> start_x, start_y, start_z;  ///< #P: positions at the start of the frame, meters
  std::vector<float> speed;                      ///< #P: mean speed over the frame, meters a second
  std::vector<Point> anchor;        ///< #P: the position where the particle last was not quiet, meters
  std::vector<std::uint8_t> stays;  ///< #P: whether the particle is near its anchor
  std::vector<float> quiet_s;       ///< #P: how long the particle has been slow or near its anchor
  float pull_m = 0.0f;              ///< a particle that contact puts back by more in a substep does not sleep
};

/// The state for this number of particles, all awake.
Sleep make_sleep(std::size_t particles, double median_edge_m);

/// Whether a particle sleeps; constraints cannot move it then.
bool sleeps(const Sleep& sleep, std::size_t particle);

/// Stores the positions of the particles [begin, end) at the start of a frame.
void begin_sleep_frame(const Particles& particles, std::size_t begin, std::size_t end, Sleep& sleep);

/// Finds the speeds of the frame, puts quiet particles to sleep, and wakes those that a neighbor or the body
/// moves.
void end_sleep_frame(const engine::Context& context, const Ring& ring, double frame_s, Particles& particles,
                     Sleep& sleep);

/// Wakes all particles.
void wake_all(Sleep& sleep);

}  // namespace bodice::cloth
