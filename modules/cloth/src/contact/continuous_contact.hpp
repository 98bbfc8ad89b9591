// Contact with a moving body. The collider has the pose at the end of the frame, but substeps end before it.
// So each particle is resolved at a shifted position, ahead by the motion that the material near it still has
// to make. The push is then applied to the particle itself, with friction relative to that material.
//
// Along the normal the shift is the whole remaining motion. Along the surface it is the share that friction
// makes cloth follow. Cloth that follows stays over the same material: a sock on a leg that swings would
// otherwise meet another part of the leg. Cloth without friction stays, and the surface passes below it.
// Each push is turned back from the pose at the end of the frame to that at the end of the substep.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "base/contact_frame.hpp"
#include "base/particles.hpp"

namespace bodice::inline v0_1::cloth {

/// The number of particles in a task of contact, and the most that resolve_moving() takes.
inline constexpr std::size_t kPatch = 512;

/// The motion of an ellipsoid's material in a frame: an affine function of where a point starts.
struct EllipsoidMotion {
  Mat3 linear = Mat3::Zero();
  Vec3 translation = Vec3::Zero();
  Vec3 rotation = Vec3::Zero();  ///< rotation vector, radians

  /// The displacement in the frame of the material that is at `start` when the frame begins, meters.
  Vec3 displacement(const Vec3& start) const { return linear * start + translation; }
};

/// The motion of the body in a frame, near each particle.
struct BodyMotion {
  float ccd_threshold_m = 0.0f;  ///< paths in a substep that are longer than this, relative to the body, take
                                 ///< continuous collision
  bool moving = false;           ///< whether the body moves in this frame
  float follow = 0.0f;  ///< the share of the body's motion along the surface that cloth follows, 0 to 1
  /// #P: displacement of the nearest material in the frame, meters; zero if the body stands still.
  std::vector<Point> displacement;
  std::vector<Point> shift;  ///< #P: the shift for a whole frame, meters: `displacement` along the normal,
                             ///< `follow` times `displacement` along the surface
  /// #P: normal of the surface there when the frame ends; zero if the body stands still.
  std::vector<Point> normal;
  std::vector<Point> rotation;  ///< #P: rotation vector of the material in the frame, times `follow`; radians
  /// #P: a ball in the body's pose at the end of the frame, with its radius as weight, meters. A particle
  /// inside it touches nothing. Where the radius is not above zero, no such ball is known.
  std::vector<Point> free_ball;
  /// #P: the sum over a substep's pushes of length times the material's displacement in the frame along it,
  /// square meters. Divided by the length of the whole push, it is the displacement along the whole push.
  std::vector<float> along_pushes_m2;
  /// #P: the ellipsoid nearest to the particle when the last frame ended, or kNoEllipsoid.
  std::vector<std::uint32_t> owner;
  std::vector<EllipsoidMotion> ellipsoids;  ///< those of the body

  /// The motion of an ellipsoid of the body; none for kNoEllipsoid.
  EllipsoidMotion of(std::uint32_t ellipsoid) const {
    return ellipsoid < ellipsoids.size() ? ellipsoids[ellipsoid] : EllipsoidMotion{};
  }
};

/// The state for this number of particles of cloth with this coefficient of friction, near a body at rest.
BodyMotion make_motion(std::size_t particles, double friction);

/// Begin and end of a substep, as fractions of its frame.
struct FrameShare {
  float begin = 0.0f, end = 1.0f;
};

/// Whether any ellipsoid of the body has a velocity.
bool is_moving(const collision::Collider& body);

/// Begins a frame: finds the motion of the body near each particle. `nearest` (#P, or empty) receives the
/// contacts of the particles after they are moved by `displacement`. Cost: a query a particle if the body
/// moves, two where owners are not known, and nothing otherwise. Precondition: `ellipsoids` has one element
/// for each ellipsoid.
void begin_motion_frame(const engine::Context& context, const ContactFrame& frame, const Particles& particles,
                        BodyMotion& motion, std::span<collision::Contact> nearest);

/// Ends a frame with a body: stores the owners of all particles. They cost a query a particle if the body
/// moved. Otherwise they are those of `nearest` (#P, or empty), the contacts when the frame began.
void end_motion_frame(const engine::Context& context, const collision::Collider& body,
                      const Particles& particles, std::span<const collision::Contact> nearest,
                      BodyMotion& motion);

/// Forgets the owners of all particles, because the particles or the body have been moved elsewhere.
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
