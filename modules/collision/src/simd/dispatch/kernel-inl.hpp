// The kernels for one instruction set: a source file defines BODICE_KERNEL_TARGET and includes this. With one
// file a target the targets compile side by side; kernels.cpp chooses among them at run time.

#include "simd/dispatch/kernel_targets.hpp"
// The instruction set must be known before the rest of Highway is read.
#include <hwy/detect_targets.h>

#if HWY_TARGETS & BODICE_KERNEL_TARGET
#undef HWY_TARGET
#define HWY_TARGET BODICE_KERNEL_TARGET
#include <hwy/highway.h>

#include "simd/dispatch/kernels.hpp"
#include "simd/narrow/first_order-inl.hpp"
#include "simd/narrow/query-inl.hpp"
#include "simd/response/resolve-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

bool query(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  return query_batch_lanes(baked, relief, batch);
}

bool query_within(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  return query_within_lanes(baked, relief, batch);
}

bool query_first_order(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  return query_first_order_lanes(baked, relief, batch);
}

bool resolve(const Baked& baked, const ReliefTables* relief, const ResponseParameters& parameters,
             const ParticleBatch& batch, BatchResponse& out) {
  return resolve_lanes(baked, relief, parameters, batch, out);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
