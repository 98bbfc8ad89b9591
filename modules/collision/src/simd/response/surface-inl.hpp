// The surfaces that particles are pushed out of, as policies of PushOut and CuttingPlanes: how the distance
// is measured at the start and after each push, and the distance that a push aims at.
#if defined(BODICE_COLLISION_SURFACE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SURFACE_INL_
#undef BODICE_COLLISION_SURFACE_INL_
#else
#define BODICE_COLLISION_SURFACE_INL_
#endif

#include <algorithm>
#include <cstring>

#include "model/tolerances.hpp"
#include "simd/narrow/in_range-inl.hpp"
#include "simd/narrow/nearest-inl.hpp"
#include "simd/narrow/other_ellipsoids-inl.hpp"
#include "simd/response/push_state-inl.hpp"
#include "simd/response/smooth_union-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr float kOvershoot = static_cast<float>(kReliefOvershoot);
constexpr float kSolverError = static_cast<float>(kClosestPointError);

/// Takes every particle of the batch.
HWY_INLINE void take_all(const Positions& at, InRange& out) {
  out.count = (at.count + kStep - 1) / kStep * kStep;
  for (int i = 0; i < out.count; i += kWidth) {
    const auto there = hn::RebindMask(I(), lanes_below(i, at.count));
    store3({hn::LoadU(f, at.x + i), hn::LoadU(f, at.y + i), hn::LoadU(f, at.z + i)}, out.x + i, out.y + i,
           out.z + i);
    hn::Store(hn::IfThenElse(there, lanes_from(i), hn::Set(I(), -1)), I(), out.lane + i);
  }
}

/// Positions of the particles of a round.
HWY_INLINE Batch batch_of(const PushedLanes& pushed) {
  return {.at = {pushed.x, pushed.y, pushed.z, pushed.count}};
}

/// The surface of plain ellipsoids. They are convex, so that only other ellipsoids are evaluated after a
/// push.
struct PlainSurface {
  static constexpr bool kConvex = true;
  static constexpr float kFirstOvershoot = 0.0f;  ///< of the first push, as a fraction of its length
  const ResponseParameters& parameters;
  Kernel<PlainUnion> kernel;

  HWY_INLINE PlainSurface(const ProxyModel& model, const ResponseParameters& p)
      : parameters(p), kernel(PlainUnion{model}) {}

  const Baked& baked() const { return kernel.model().baked; }
  /// Distance that pushes aim at. It is beyond the clearance by the error of the closest point, so that its
  /// ellipsoid need not be evaluated again. `owner` may be -1.
  HWY_INLINE V target(VI owner) const {
    constexpr int kStride = kBakedFloats;
    const VI at = hn::Mul(hn::Max(owner, hn::Zero(I())), hn::Set(I(), kStride));
    const V longest = hn::GatherIndex(f, &baked().ellipsoids.data()->longest_m, at);
    return hn::MulAdd(all(kSolverError), hn::Add(longest, all(std::max(0.0f, parameters.clearance_m))),
                      all(parameters.clearance_m + parameters.slack_m));
  }
  /// Evaluates the initial positions of all particles that may be below the clearance.
  HWY_INLINE Status measure_first(Batch& batch, InRange& in_range, BatchResults& out) {
    const Status status = nearest_in_range(kernel, batch, parameters.clearance_m, in_range, out);
    if (status == Status::kDone) return status;
    take_all(batch.at, in_range);
    alignas(64) std::int32_t none[kBatch];
    std::memset(none, 0xFF, sizeof(none));
    return nearest_others(kernel, {batch, none, none, none}, parameters.clearance_m, out);
  }
  /// Evaluates the current positions where one is below the clearance.
  HWY_INLINE Status measure_again(const PushedLanes& pushed, BatchResults& out) {
    const Batch batch = batch_of(pushed);
    return nearest_others(kernel, {batch, pushed.clear1, pushed.clear2, pushed.clear3},
                          parameters.clearance_m, out);
  }
};

/// The surface with relief. Its normal turns between steps, and a fraction of the blend radius more lets
/// Newton arrive from below.
template <class Union>
struct ReliefSurface {
  static constexpr bool kConvex = false;
  static constexpr float kFirstOvershoot = static_cast<float>(kStepOvershoot);
  const ResponseParameters& parameters;
  Kernel<Union> kernel;

  HWY_INLINE ReliefSurface(const ProxyModel& model, const ResponseParameters& p)
      : parameters(p), kernel(Union{model}) {}

  const Baked& baked() const { return kernel.model().baked; }
  HWY_INLINE V target(VI) const {
    const float least_m = parameters.clearance_m + parameters.slack_m;
    return all(least_m + kOvershoot * kernel.model().blend_m());
  }
  HWY_INLINE Status measure_first(Batch& batch, InRange& in_range, BatchResults& out) {
    const Status status = nearest_in_range(kernel, batch, parameters.clearance_m, in_range, out);
    if (status == Status::kDone) return status;
    take_all(batch.at, in_range);
    return nearest(kernel, batch, out);
  }
  HWY_INLINE Status measure_again(const PushedLanes& pushed, BatchResults& out) {
    // The first push reaches the surface, and the later ones only correct it.
    kernel.broad.reuse_within(kernel.model().blend_m());
    Batch batch = batch_of(pushed);
    return nearest(kernel, batch, out);
  }
};

/// The smooth union of plain ellipsoids, which has fillets in its creases.
struct FilletedSurface {
  static constexpr bool kConvex = false;
  static constexpr float kFirstOvershoot = 0.0f;
  const ProxyModel& model;
  const ResponseParameters& parameters;
  const TangentCandidates& candidates;  ///< those of the block

  const Baked& baked() const { return model.baked; }
  HWY_INLINE V target(VI) const {
    constexpr float kFillet = static_cast<float>(kFilletOvershoot);
    const float least_m = parameters.clearance_m + parameters.slack_m;
    return all(least_m + std::min(kOvershoot * parameters.blend_m, kFillet * parameters.slack_m));
  }
  HWY_INLINE Status measure_first(Batch& batch, InRange& in_range, BatchResults& out) {
    take_all(batch.at, in_range);
    measure(batch.at, out);
    return Status::kDone;
  }
  HWY_INLINE Status measure_again(const PushedLanes& pushed, BatchResults& out) {
    measure(batch_of(pushed).at, out);
    return Status::kDone;
  }

 private:
  /// Evaluates the smooth union at all positions.
  HWY_INLINE void measure(const Positions& at, BatchResults& out) const {
    const ResponseParameters& c = parameters;
    for (int i = 0; i < at.count; i += kWidth) {
      const V3 p = load3(at.x + i, at.y + i, at.z + i);
      const Sample s = smooth_distance(baked(), c.blend_m, candidates, p, all(c.clearance_m + c.blend_m));
      hn::Store(s.distance, f, out.distance + i);
      hn::Store(hn::Sqrt(dot(s.gradient, s.gradient)), f, out.value + i);
      store3(unit(s.gradient), out.gx + i, out.gy + i, out.gz + i);
      const VI owner = hn::Max(s.owner, hn::Zero(I()));
      hn::Store(hn::GatherIndex(I(), baked().proxy_index.data(), owner), I(), out.proxy_index + i);
    }
  }
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
