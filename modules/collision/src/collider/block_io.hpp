// Copies particles between the caller's arrays and the kernels' blocks.
#pragma once

#include <cstdint>
#include <span>

#include <bodice/collision/collider.hpp>

#include "model/batch.hpp"
#include "model/particle_view.hpp"

namespace bodice::inline v0_1::collision {

/// A batch of particles and their indices in the caller's arrays.
struct GatheredBatch {
  ParticleBatch batch;
  std::uint32_t index[kBatch];  ///< one a lane
  std::uint32_t far[kBatch];    ///< finite, but too far away for floats
  int far_count = 0;
  std::uint64_t not_finite = 0;
};

/// Gathers the end - begin particles of `index`, or [begin, end) if it is null; at most kBatch. Particles
/// that are not finite are left out and counted.
void gather(const ParticleView& particles, const std::uint32_t* index, std::size_t begin, std::size_t end,
            GatheredBatch& out);

/// Writes the positions and velocities of a response back.
void scatter(const GatheredBatch& gathered, const BatchResponse& response, const ParticleView& particles);

}  // namespace bodice::collision
