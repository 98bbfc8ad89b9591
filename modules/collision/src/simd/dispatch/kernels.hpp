// The float kernels, one batch of neighboring particles a call, compiled for several instruction sets and
// chosen at run time.
#pragma once

#include "model/baked.hpp"
#include "model/batch.hpp"
#include "model/relief_tables.hpp"

namespace bodice::collision {

/// Fills in the contacts of the batch. False on overflow or if a particle is not within kFarthest_m; some
/// contacts are then unchanged.
bool query_batch(const Baked& baked, const ReliefTables* relief, QueryBatch& batch);

/// Closest-point response of a batch; false on overflow.
bool resolve_batch(const Baked& baked, const ReliefTables* relief, const ResponseParameters& parameters,
                   const ParticleBatch& batch, BatchResponse& out);

/// Name of the instruction set in use.
const char* kernel_target();

}  // namespace bodice::collision
