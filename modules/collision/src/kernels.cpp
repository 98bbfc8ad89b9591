#include "kernels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

// Machines between these, and those above AVX3, whose bits lie below its own, are served by the next lower
// one; scalable vectors cannot be kept in structures.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | (HWY_AVX3 - 1) | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// Where none of these runs: a lane at a time, as g++ has it. The emulated vectors that Highway has instead
// for clang take clang 14 over ten minutes to compile.
#define HWY_BROKEN_EMU128 1
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <hwy/highway.h>

#include "simd/first_order-inl.hpp"
#include "simd/query-inl.hpp"
#include "simd/resolve-inl.hpp"

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

bool resolve(const Baked& baked, const ReliefTables* relief, const Clearance& clearance,
             const Gathering& batch, BatchResponse& out) {
  return resolve_lanes(baked, relief, clearance, batch, out);
}

const char* target() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bodice::collision {

HWY_EXPORT(query);
HWY_EXPORT(query_within);
HWY_EXPORT(query_first_order);
HWY_EXPORT(resolve);
HWY_EXPORT(target);

bool query_batch(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  // Where too many ellipsoids are near for the lists, exact queries have a way out.
  if (batch.accuracy == Accuracy::kFirstOrder &&
      HWY_DYNAMIC_DISPATCH(query_first_order)(baked, relief, batch))
    return true;
  if (batch.limited()) return HWY_DYNAMIC_DISPATCH(query_within)(baked, relief, batch);
  return HWY_DYNAMIC_DISPATCH(query)(baked, relief, batch);
}

bool resolve_batch(const Baked& baked, const ReliefTables* relief, const Clearance& clearance,
                   const Gathering& batch, BatchResponse& out) {
  return HWY_DYNAMIC_DISPATCH(resolve)(baked, relief, clearance, batch, out);
}

const char* kernel_target() {
  return HWY_DYNAMIC_DISPATCH(target)();
}

}  // namespace bodice::collision
#endif
