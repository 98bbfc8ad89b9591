// Contact with the body at the end of a substep: the collider moves particles out, this adds Coulomb friction
// on positions, against the body's material, and takes the velocity that pushing out would give.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/cloth/solver.hpp>

#include "base/particles.hpp"
#include "contact/clearance_cache.hpp"
#include "contact/continuous_contact.hpp"

namespace bodice::cloth {

static_assert(kPatch % kCluster == 0);

struct ContactPatch {
  collision::ContactReport report;  ///< since the frame began
  std::int64_t spent_ns = 0;        ///< inside the collider, since the frame began
};

struct ContactState {
  std::vector<std::uint8_t> touching;  ///< #P, moved by the collider in the last substep
  std::vector<ContactPatch> patch;     ///< #P / kPatch
  Clearance clearance;
  Carry carry;
};

/// One of a frame's substeps.
struct Substep {
  float length_s = 0.0f;
  FrameShare share;
};

ContactState make_contacts(std::size_t particles);

/// `moved`: as moves(*collider) has it; `travel_m`: as begin_clearance() has it.
void begin_contact_frame(const engine::Context& context, const collision::Collider* collider, bool moved,
                         const SolverOptions& options, double frame_s, double travel_m, Particles& particles,
                         ContactState& state);

/// Takes the positions from the points, where the constraints left them, and moves them out of the body;
/// old_* are those at the start of the substep. Sets the velocities of all particles. `collider` may be null:
/// no body. Returns FrameLimit bits: a particle that is not finite goes back to where the substep began.
std::uint32_t meet_body(const engine::Context& context, const collision::Collider* collider,
                        const SolverOptions& options, float friction, const Substep& substep,
                        ContactState& state, Particles& particles);

/// What happened since begin_contact_frame().
void report_contacts(const ContactState& state, FrameReport& report);

}  // namespace bodice::cloth
