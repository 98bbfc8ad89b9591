// Between the caller's arrays and the kernels' blocks.
#pragma once

#include <cstdint>
#include <span>

#include <bodice/collision/collider.hpp>

#include "model/batch.hpp"

namespace bodice::collision {

/// A batch and whose particles it holds.
struct GatheredBatch {
  ParticleBatch batch;
  std::uint32_t index[kBatch];  ///< into the caller's arrays, a lane
  std::uint32_t far[kBatch];    ///< finite but too far for floats
  int far_count = 0;
  std::uint64_t not_finite = 0;
};

/// Gathers end - begin particles, at most kBatch: those of the index, or [begin, end) if it is null.
/// Particles with a coordinate that is not finite are left out and counted.
void gather(const Particles& particles, const std::uint32_t* index, std::size_t begin, std::size_t end,
            GatheredBatch& out);

/// Writes the positions and velocities of a response back.
void scatter(const GatheredBatch& gathered, const BatchResponse& response, const Particles& particles);

}  // namespace bodice::collision
