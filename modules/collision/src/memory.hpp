// What a Workspace holds.
#pragma once

#include "kept.hpp"
#include "particle_order.hpp"

namespace bodice::collision {

struct Memory {
  ParticleOrder order;
  KeptCandidates candidates;
};

}  // namespace bodice::collision
