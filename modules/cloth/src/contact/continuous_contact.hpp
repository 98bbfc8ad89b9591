// Contact with a moving body. The collider has the pose at the end of the frame, but substeps end before. So
// each particle is shifted by the remaining motion of the material near it before it is resolved, and
// friction acts relative to that material.
//
// The shift has a share of the motion along the surface, that which friction makes cloth follow. Cloth that
// is carried stays over the same material: a sock on a leg that swings would otherwise meet another part of
// it. Cloth without friction stays where it is, and the surface passes below it. What is found there is
// turned back to the body as it is when the substep ends, by the same share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "base/contact_frame.hpp"
#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// Particles a task of contact, and the most that resolve_moving() takes.
inline constexpr std::size_t kPatch = 512;

/// The motion of the body in a frame, near each particle.
struct BodyMotion {
  float ccd_threshold_m =
      0.0f;               ///< a longer path relative to the body in a substep takes continuous collision
  bool moving = false;    ///< whether the body moves in this frame
  float follow = 0.0f;    ///< the share of motion along the surface that the cloth follows, from 0 to 1
  std::vector<Point> by;  ///< #P: displacement in the frame of the nearest material, meters; zero at rest
  std::vector<Point>
      shift;  ///< #P: what the body sees of `by`: all along the normal, `follow` along the surface
  std::vector<Point> normal;  ///< #P: of the surface there when the frame ends; zero at rest
  std::vector<Point> turn;    ///< #P: rotation vector of the material in the frame, times `follow`; radians
  /// #P: a point near the body as it is when the frame ends, and as its weight a radius, meters: nothing that
  /// close to the point touches the body. Not above zero: it may.
  std::vector<Point> clear;
  /// #P: over the pushes of a substep, the sum of their lengths times the displacement in the frame of what
  /// pushed along them, square meters. Over the length of their sum it is the displacement along that.
  std::vector<float> along;
  std::vector<std::uint32_t> owner;  ///< #P: nearest ellipsoid when the frame before ended, or kNoEllipsoid
  std::vector<Vec3> turns;           ///< #ellipsoids of the body: how each turns in the frame, radians
};

/// Motion for so many particles of cloth with this coefficient of friction, near a body at rest.
BodyMotion make_motion(std::size_t particles, double friction);

/// Begin and end of a substep, as fractions of its frame.
struct FrameShare {
  float begin = 0.0f, end = 1.0f;
};

/// Whether any ellipsoid of the body has a velocity.
bool is_moving(const collision::Collider& body);

/// Begins a frame. `nearest` takes the contacts of the particles (#P, or empty), displaced by `by`. Costs a
/// query a particle if the body moves, two where owners are not known, and nothing otherwise. Precondition:
/// `turns` has the size of the body.
void begin_motion_frame(const engine::Context& context, const ContactFrame& frame, const Particles& particles,
                        BodyMotion& motion, std::span<collision::Contact> nearest);

/// Ends a frame with a body: notes the owners of all particles. That costs a query a particle where the body
/// moved; where it did not, they are those of `nearest` (#P, or empty), the contacts when the frame began.
void end_motion_frame(const engine::Context& context, const collision::Collider& body,
                      const Particles& particles, std::span<const collision::Contact> nearest,
                      BodyMotion& motion);

/// Forgets the owners of all particles: these, or the body, are no longer where they were.
void forget_owners(BodyMotion& motion);

/// One of a frame's substeps.
struct Substep {
  float length_s = 0.0f;
  FrameShare share;

  float inverse_per_s() const { return 1.0f / length_s; }  ///< of its length
};

/// The contact of cloth with the body in a substep.
struct BodyContact {
  const collision::Collider* body = nullptr;  ///< null: there is no body
  collision::ResolveOptions how;
  Substep substep;
};

/// Moves the particles [begin, end) out of a moving body in its pose at the end of a substep; old_* are their
/// positions at the start of the substep.
collision::ContactReport resolve_moving(const engine::Context& context, const BodyContact& contact,
                                        BodyMotion& motion, std::size_t begin, std::size_t end,
                                        Particles& particles);

}  // namespace bodice::cloth
