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
#include "simd/dispatch/resolve_batch-inl.hpp"
#include "simd/narrow/first_order-inl.hpp"
#include "simd/narrow/query-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

Status query(const ProxyModel& model, Batch& batch, const ContactOutput& out) {
  return with_union(model, [&](const auto& proxy) { return query_all(proxy, batch, out); });
}

Status query_within(const ProxyModel& model, Batch& batch, const ContactOutput& out) {
  return with_union(model, [&](const auto& proxy) { return query_within(proxy, batch, out); });
}

Status query_first_order(const ProxyModel& model, Batch& batch, const ContactOutput& out) {
  return with_union(model, [&](const auto& proxy) { return query_first_order(proxy, batch, out); });
}

Status resolve(const ProxyModel& model, const ResponseParameters& parameters, const ParticleBatch& batch,
               BatchResponse& out) {
  return resolve_on_surface(model, parameters, batch, out);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
