// The body contact pass at the end of a substep. The collider moves particles out; this adds Coulomb friction
// on positions, relative to the body's material, and removes the velocity that the push would give.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/cloth/solver.hpp>

#include "base/particles.hpp"
#include "contact/clearance_cache.hpp"
#include "contact/continuous_contact.hpp"
#include "faces/certificate.hpp"

namespace bodice::inline v0_1::cloth {

static_assert(kPatch % kCluster == 0 && kPatch % kTravelCluster == 0);

/// What happened to a patch of particles since the frame began.
struct ContactPatch {
  collision::ContactReport report;
  std::int64_t spent_ns = 0;  ///< time inside the collider
};

/// The state of body contact.
struct ContactState {
  float friction = 0.0f;    ///< coefficient of friction of the cloth
  std::vector<float> grip;  ///< #P: the share of that friction which acts on a body that moves, from 0 to 1
  std::vector<std::uint8_t> touching;  ///< #P: whether the collider moved the particle in the last substep
  std::vector<ContactPatch> patch;     ///< #P / kPatch
  ClearanceCache clearance;
  BodyMotion motion;
  FaceContact faces;
  FaceCertificate certificate;
  FaceProof proof;
};

/// The state for so many particles of cloth with this coefficient of friction; `faces` are those of
/// make_face_contact().
ContactState make_contacts(std::size_t particles, double friction, FaceContact faces);

/// Begins a frame.
void begin_contact_frame(const engine::Context& context, const ContactFrame& frame,
                         const SolverOptions& options, Particles& particles, ContactState& state);

/// Copies the points, which constraints moved, to the positions, moves these and the faces between them out
/// of the body, and sets the velocities of all particles; old_* are the positions at the start of the
/// substep. `collider` may be null: there is no body. A particle that is not finite returns to its old
/// position. Returns FrameLimit bits.
std::uint32_t resolve_body_contacts(const engine::Context& context, const collision::Collider* collider,
                                    const SolverOptions& options, const Substep& substep, ContactState& state,
                                    Particles& particles);

/// Ends a frame with a body: proves that faces are out of it, if the options ask for that.
void end_contact_frame(const engine::Context& context, const collision::Collider& collider,
                       const SolverOptions& options, ContactState& state, Particles& particles);

/// Adds what happened since begin_contact_frame() to the report.
void report_contacts(const ContactState& state, FrameReport& report);

}  // namespace bodice::cloth
