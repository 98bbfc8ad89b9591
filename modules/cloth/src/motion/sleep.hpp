// Particles that hardly moved for a while hold still, so that a garment at rest is at rest. So do those that
// only tremble: what a sweep leaves unsolved can swing a fold to and fro for ever where substeps are few.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "garment/topology.hpp"

namespace bodice::cloth {

struct Sleep {
  std::vector<float> start_x, start_y, start_z;  ///< #P, meters, at the start of the frame
  std::vector<float> speed;                      ///< #P, meters a second, mean over the frame
  std::vector<Point> place;                      ///< #P, meters, where the particle last was not quiet
  std::vector<std::uint8_t> stays;               ///< #P, near that place
  std::vector<float> quiet_s;                    ///< #P, how long the particle has been slow or near it
};

Sleep make_sleep(std::size_t particles);

/// A sleeping particle is one that the constraints cannot move.
bool sleeps(const Sleep& sleep, std::size_t particle);

void begin_sleep_frame(const Particles& particles, std::size_t begin, std::size_t end, Sleep& sleep);

/// Speeds of the frame; who falls asleep, and who wakes because a neighbor or the body moves it. Returns the
/// largest speed.
float end_sleep_frame(const engine::Context& context, const Ring& ring, double frame_s, Particles& particles,
                      Sleep& sleep);

void wake_all(Sleep& sleep);

}  // namespace bodice::cloth
