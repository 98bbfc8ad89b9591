// The float kernels, one batch of neighboring particles a call, compiled for several instruction sets and
// chosen at run time.
#pragma once

#include "model/batch.hpp"
#include "model/fallback.hpp"
#include "model/proxy_model.hpp"

namespace bodice::inline v0_1::collision {

/// Writes the contacts of the batch; unless it is done, some contacts are unchanged.
Status query_batch(const ProxyModel& model, Accuracy accuracy, Batch& batch, const ContactOutput& out);

/// Closest-point response of a batch; unless it is done, `out` is not valid.
Status resolve_batch(const ProxyModel& model, const ResponseParameters& parameters,
                     const ParticleBatch& batch, BatchResponse& out);

/// Name of the instruction set in use.
const char* kernel_target();

}  // namespace bodice::collision
