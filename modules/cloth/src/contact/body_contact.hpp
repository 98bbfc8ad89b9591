// The contact of a substep with the body, which comes after the constraints. The collider moves particles
// out. This file adds Coulomb friction on positions, relative to the body's material, and removes the
// velocity that the push would give.
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

/// The contacts of a patch of particles since the frame began.
struct ContactPatch {
  collision::ContactReport report;
  std::int64_t spent_ns = 0;  ///< time inside the collider
};

/// The state of body contact.
struct ContactState {
  float friction = 0.0f;               ///< coefficient of friction of the cloth
  std::vector<float> friction_share;   ///< #P: the share of `friction` that acts while the body moves, 0 to 1
  std::vector<std::uint8_t> touching;  ///< #P: whether the collider moved the particle in the last substep
  std::vector<Point> normal;           ///< #P: the surface's normal there if it did; zero while deep inside
  std::vector<ContactPatch> patch;     ///< #P / kPatch
  ClearanceCache clearance;
  BodyMotion motion;
  FaceContact faces;
  FaceCertificate certificate;
  FaceProof proof;
};

/// The state for this number of particles of cloth with this coefficient of friction. `faces` is the result
/// of make_face_contact().
ContactState make_contacts(std::size_t particles, double friction, FaceContact faces);

/// Begins a frame: finds the body's motion near the particles, their clearances and the samples of faces.
void begin_contact_frame(const engine::Context& context, const ContactFrame& frame,
                         const SolverOptions& options, Particles& particles, ContactState& state);

/// Resolves the contacts of a substep. Copies the points, which constraints moved, to the positions. Moves
/// these, and the faces between them, out of the body. Sets the velocities of all particles; old_* are the
/// positions at the start of the substep. A null `collider` means that there is no body. A particle that is
/// not finite returns to its old position. Returns FrameLimit bits.
std::uint32_t resolve_body_contacts(const engine::Context& context, const collision::Collider* collider,
                                    const SolverOptions& options, const Substep& substep, ContactState& state,
                                    Particles& particles);

/// Ends a frame with a body: proves that triangles are out of it, if SolverOptions::certify_m is set.
void end_contact_frame(const engine::Context& context, const collision::Collider& collider,
                       const SolverOptions& options, ContactState& state, Particles& particles);

/// Adds contacts, proofs and times since begin_contact_frame() to the report.
void report_contacts(const ContactState& state, FrameReport& report);

}  // namespace bodice::cloth
