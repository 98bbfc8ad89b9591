// Contact with a moving body. The collider has the pose at the end of the frame, but substeps end before. So
// each particle is displaced by the remaining motion of the surface near it before it is resolved, and
// friction acts relative to the body's material.
#pragma once

#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"

namespace bodice::cloth {

/// Particles a task of contact, and the most that resolve_moving() takes.
inline constexpr std::size_t kPatch = 512;

/// The motion of the body in a frame, near each particle.
struct BodyMotion {
  float ccd_threshold_m =
      0.0f;                  ///< a longer path relative to the body in a substep takes continuous collision
  bool moving = false;       ///< whether the body moves in this frame
  std::vector<Point> by;     ///< #P: displacement in the frame of the nearest material, meters; zero at rest
  std::vector<Point> ahead;  ///< #P: the component of `by` along the surface's normal
};

/// Begin and end of a substep, as fractions of its frame.
struct FrameShare {
  float begin = 0.0f, end = 1.0f;
};

/// Whether any ellipsoid of the body has a velocity.
bool is_moving(const collision::Collider& body);

/// Begins a frame of `frame_s` at the end of which the body has its current pose; null: no body moves. It
/// costs two queries a particle if the body moves, and nothing otherwise. `nearest` takes the contacts of the
/// particles (#P, or empty), displaced by `by`.
void begin_motion_frame(const engine::Context& context, const collision::Collider* moving_body,
                        double frame_s, const Particles& particles, BodyMotion& motion,
                        std::span<collision::Contact> nearest);

/// Moves the particles [begin, end) out of a moving body in its pose at the end of a substep; old_* are their
/// positions at the start of the substep.
collision::ContactReport resolve_moving(const engine::Context& context, const collision::Collider& body,
                                        const collision::ResolveOptions& how, const BodyMotion& motion,
                                        const FrameShare& substep, std::size_t begin, std::size_t end,
                                        Particles& particles);

}  // namespace bodice::cloth
