// The float kernels, one batch of neighboring particles a call, compiled for several instruction sets and
// chosen at run time.
#pragma once

#include "model/baked.hpp"
#include "model/batch.hpp"
#include "model/relief_tables.hpp"

namespace bodice::collision {

/// Fills in the contacts of the batch; false, and some left as they were, if too many ellipsoids are near or
/// a place is not within kFarthest_m.
bool query_batch(const Baked& baked, const ReliefTables* relief, QueryBatch& batch);

/// The nearest response; false if too many ellipsoids are near for the kernel.
bool resolve_batch(const Baked& baked, const ReliefTables* relief, const ResponseParameters& parameters,
                   const ParticleBatch& batch, BatchResponse& out);

/// The proxy_index of the instruction set in use.
const char* kernel_target();

}  // namespace bodice::collision
