#include "simd/dispatch/kernels.hpp"

#include "simd/dispatch/kernel_targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/dispatch/kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

// These are defined in kernels_<target>.cpp.
bool query(const Baked& baked, const ReliefTables* relief, QueryBatch& batch);
bool query_within(const Baked& baked, const ReliefTables* relief, QueryBatch& batch);
bool query_first_order(const Baked& baked, const ReliefTables* relief, QueryBatch& batch);
bool resolve(const Baked& baked, const ReliefTables* relief, const ResponseParameters& parameters,
             const ParticleBatch& batch, BatchResponse& out);

const char* target() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bodice::collision {

static_assert((HWY_TARGETS & ~(HWY_STATIC_TARGET | HWY_SCALAR | HWY_SSE4 | HWY_AVX2 | HWY_AVX3 | HWY_NEON)) ==
                  0,
              "an instruction set has no kernels_<target>.cpp: add one, or disable it in kernel_targets.hpp");

HWY_EXPORT(query);
HWY_EXPORT(query_within);
HWY_EXPORT(query_first_order);
HWY_EXPORT(resolve);
HWY_EXPORT(target);

bool query_batch(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  // On overflow the exact query is the fallback.
  if (batch.accuracy == Accuracy::kFirstOrder &&
      HWY_DYNAMIC_DISPATCH(query_first_order)(baked, relief, batch))
    return true;
  if (batch.limited()) return HWY_DYNAMIC_DISPATCH(query_within)(baked, relief, batch);
  return HWY_DYNAMIC_DISPATCH(query)(baked, relief, batch);
}

bool resolve_batch(const Baked& baked, const ReliefTables* relief, const ResponseParameters& parameters,
                   const ParticleBatch& batch, BatchResponse& out) {
  return HWY_DYNAMIC_DISPATCH(resolve)(baked, relief, parameters, batch, out);
}

const char* kernel_target() {
  return HWY_DYNAMIC_DISPATCH(target)();
}

}  // namespace bodice::collision
#endif
