// Contact with the body at the end of a substep: the collider moves particles out, this adds Coulomb friction
// on positions and takes the velocity that pushing out would give.
#pragma once

#include <vector>

#include <bodice/cloth/solver.hpp>

#include "particles.hpp"

namespace bodice::cloth {

/// Scratch of contacts, #P each.
struct ContactState {
  std::vector<float> before_x, before_y, before_z;  ///< metres, before the collider's response
  std::vector<std::uint8_t> touching;               ///< moved by the collider in the last substep
};

ContactState make_contacts(std::size_t particles);

/// Positions are those after the constraints, old_* those at the start of the substep. Sets the velocities of
/// all particles. `collider` may be null: no body.
collision::ContactReport finish_substep(const engine::Context& context, const collision::Collider* collider,
                                        const SolverOptions& options, float friction, float substep_s,
                                        ContactState& state, Particles& particles);

}  // namespace bodice::cloth
