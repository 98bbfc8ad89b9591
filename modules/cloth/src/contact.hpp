// Contact with the body at the end of a substep: the collider moves particles out, this adds Coulomb friction
// on positions and takes the velocity that pushing out would give.
#pragma once

#include <vector>

#include <bodice/cloth/solver.hpp>

#include "particles.hpp"

namespace bodice::cloth {

struct ContactState {
  std::vector<std::uint8_t> touching;  ///< #P, moved by the collider in the last substep
  collision::Workspace workspace;
};

ContactState make_contacts(std::size_t particles);

/// Takes the positions from the points, which keep them. A particle that is not finite goes back to where the
/// substep began. Returns FrameLimit bits.
std::uint32_t take_from_points(const engine::Context& context, Particles& particles);

/// Positions are those after the constraints, as the points are; old_* those at the start of the substep.
/// Sets the velocities of all particles. `collider` may be null: no body.
collision::ContactReport meet_body(const engine::Context& context, const collision::Collider* collider,
                                   const SolverOptions& options, float friction, float substep_s,
                                   ContactState& state, Particles& particles);

}  // namespace bodice::cloth
