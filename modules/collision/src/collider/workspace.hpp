// What a Workspace holds.
#pragma once

#include "model/candidate_cache.hpp"
#include "model/particle_order.hpp"

namespace bodice::collision {

struct Memory {
  ParticleOrder order;
  KeptCandidates candidates;
};

}  // namespace bodice::collision
