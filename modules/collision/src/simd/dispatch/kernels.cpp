#include "simd/dispatch/kernels.hpp"

#include "simd/dispatch/kernel_targets.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/dispatch/kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

// These are defined in kernels_<target>.cpp.
Status query(const ProxyModel& model, Batch& batch, const ContactOutput& out);
Status query_within(const ProxyModel& model, Batch& batch, const ContactOutput& out);
Status query_first_order(const ProxyModel& model, Batch& batch, const ContactOutput& out);
Status resolve(const ProxyModel& model, const ResponseParameters& parameters, const ParticleBatch& batch,
               BatchResponse& out);

const char* target() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bodice::inline v0_1::collision {

static_assert((HWY_TARGETS & ~(HWY_STATIC_TARGET | HWY_SCALAR | HWY_SSE4 | HWY_AVX2 | HWY_AVX3 | HWY_NEON)) ==
                  0,
              "an instruction set has no kernels_<target>.cpp: add one, or disable it in kernel_targets.hpp");

HWY_EXPORT(query);
HWY_EXPORT(query_within);
HWY_EXPORT(query_first_order);
HWY_EXPORT(resolve);
HWY_EXPORT(target);

Status query_batch(const ProxyModel& model, Accuracy accuracy, Batch& batch, const ContactOutput& out) {
  if (accuracy == Accuracy::kFirstOrder) {
    const Status status = HWY_DYNAMIC_DISPATCH(query_first_order)(model, batch, out);
    // On overflow the exact query is the fallback.
    if (status != Status::kTooMany) return status;
  }
  if (out.limited()) return HWY_DYNAMIC_DISPATCH(query_within)(model, batch, out);
  return HWY_DYNAMIC_DISPATCH(query)(model, batch, out);
}

Status resolve_batch(const ProxyModel& model, const ResponseParameters& parameters,
                     const ParticleBatch& batch, BatchResponse& out) {
  return HWY_DYNAMIC_DISPATCH(resolve)(model, parameters, batch, out);
}

const char* kernel_target() {
  return HWY_DYNAMIC_DISPATCH(target)();
}

}  // namespace bodice::collision
#endif
