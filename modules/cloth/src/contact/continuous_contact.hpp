// A body that moves shows the pose where its frame ends, but substeps fall in between. So each particle is
// met as far on as the surface under it still has to go; friction holds it to the body's material instead of
// to the world.
#pragma once

#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"

namespace bodice::cloth {

/// Particles a task of contact, and the most that meet_carried() takes.
inline constexpr std::size_t kPatch = 512;

struct Carry {
  float followed_m = 0.0f;   ///< who comes farther in a substep, against the body, is followed on its way
  bool moving = false;       ///< in this frame
  std::vector<Point> by;     ///< #P, meters in the frame, of the material nearest to each; zero if none moves
  std::vector<Point> ahead;  ///< #P, its part along the surface's normal
};

/// A substep's part of its frame, as shares of it.
struct FrameShare {
  float begin = 0.0f, end = 1.0f;
};

/// Whether anything of the body moved to where it is now.
bool moves(const collision::Collider& body);

/// Begins a frame in which the body comes to where it is now, `frame_s` after where it was; null: none moves.
/// Cost: two queries a particle if it moves, nothing otherwise.
void begin_carry(const engine::Context& context, const collision::Collider* moving_body, double frame_s,
                 const Particles& particles, Carry& carry);

/// Moves the particles [begin, end) out of a moving body as it stands at the end of a substep; old_* is where
/// they were at its begin.
collision::ContactReport meet_carried(const engine::Context& context, const collision::Collider& body,
                                      const collision::ResolveOptions& how, const Carry& carry,
                                      const FrameShare& substep, std::size_t begin, std::size_t end,
                                      Particles& particles);

}  // namespace bodice::cloth
