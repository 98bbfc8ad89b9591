// Between the caller's arrays and the kernels' blocks.
#pragma once

#include <cstdint>
#include <span>

#include <bodice/collision/collider.hpp>

#include "kernels.hpp"

namespace bodice::collision {

/// A batch and whose particles it holds.
struct Gathered {
  Gathering batch;
  std::uint32_t index[kBatch];  ///< into the caller's arrays, a lane
  std::uint32_t far[kBatch];    ///< finite but too far for floats
  int far_count = 0;
  std::uint64_t not_finite = 0;
};

/// Gathers end - begin particles, at most kBatch: those of the index, or [begin, end) if it is null.
/// Particles with a coordinate that is not finite are left out and counted.
void gather(const Particles& particles, const std::uint32_t* index, std::size_t begin, std::size_t end,
            Gathered& out);

/// Writes the position and velocity of one lane back.
void scatter(const Gathered& gathered, int lane, const Particles& particles);

/// Those of all lanes, which are the caller's from `begin` on.
void scatter_all(const Gathered& gathered, std::size_t begin, const Particles& particles);

}  // namespace bodice::collision
