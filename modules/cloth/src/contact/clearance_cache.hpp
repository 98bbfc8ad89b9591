// Who cannot meet the body in this frame: distances are asked once, and what a cluster of particles travels
// since is taken off them. The collider sees the others only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"

namespace bodice::cloth {

/// Neighbors on the cloth; as many as a block of the collider's kernels.
inline constexpr std::size_t kCluster = 64;

struct Clearance {
  std::vector<float> free_m;                ///< a cluster: may be traveled before one of it can touch
  std::vector<collision::Contact> nearest;  ///< #P
  float slope = 1.0f;                       ///< meters of distance that a meter of travel takes off at most
  int frames_without = 0;                   ///< until distances are worth asking again
};

Clearance make_clearance(std::size_t particles);

/// Begins a frame. Everything counts as near without a body that stands still (what one sweeps over says
/// nothing to distances at its end), and for some frames after most was found near. `touching`: who was moved
/// by the body in the substep before, #P. `travel_m`: nobody is expected to go farther in the frame;
/// distances that this cannot use up are not asked for (who does go farther meets the collider in time).
void begin_clearance(const engine::Context& context, const collision::Collider* still_body,
                     double thickness_m, double travel_m, std::span<const std::uint8_t> touching,
                     Particles& particles, Clearance& clearance);

/// Whether the particles [begin, end) of a cluster, moved from old_* to their positions, may touch now.
bool may_touch(const Particles& particles, std::size_t begin, std::size_t end, Clearance& clearance);

}  // namespace bodice::cloth
