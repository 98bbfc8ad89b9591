// The data of a Workspace.
#pragma once

#include "model/candidate_cache.hpp"
#include "model/particle_order.hpp"

namespace bodice::inline v0_1::collision {

/// The spatial order and the candidate cache of one set of particles.
struct WorkspaceData {
  explicit WorkspaceData(engine::MemoryResource* memory) : order(memory), candidates(memory) {}

  ParticleOrder order;
  CandidateCache candidates;
};

}  // namespace bodice::collision
