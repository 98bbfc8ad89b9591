// Pushes particles until none is below the clearance. Plain ellipsoids are convex: each one that a position
// violates adds the half-space beyond its tangent plane, and a point in all half-spaces is clear of those
// ellipsoids. On relief and fillets this becomes Newton's method along the gradient.
#if defined(BODICE_COLLISION_CUTTING_PLANES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CUTTING_PLANES_INL_
#undef BODICE_COLLISION_CUTTING_PLANES_INL_
#else
#define BODICE_COLLISION_CUTTING_PLANES_INL_
#endif

#include "model/tolerances.hpp"
#include "simd/math/planes-inl.hpp"
#include "simd/narrow/in_range-inl.hpp"
#include "simd/narrow/other_ellipsoids-inl.hpp"
#include "simd/response/push_state-inl.hpp"
#include "simd/response/smooth_union-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kPlainRounds = 6;
constexpr int kReliefRounds = 6;
constexpr float kOvershoot = static_cast<float>(kReliefOvershoot);
constexpr float kSolverError = static_cast<float>(kClosestPointError);

/// The surface that particles are pushed out of: that of the proxy, or of the smooth union.
struct Surface {
  const Baked& baked;
  const ReliefTables* relief;
  const ResponseParameters& parameters;
  const TangentCandidates* filleted;  ///< of the block; null: creases stay sharp, or relief blends
  Scratch& scratch;

  bool nonconvex() const { return relief != nullptr || filleted != nullptr; }
  /// Distance that pushes aim at. On a nonconvex surface the normal turns between steps, and a fraction of
  /// the blend radius more lets Newton arrive from below.
  float target_m() const {
    const float least_m = parameters.clearance_m + parameters.slack_m;
    if (relief) return least_m + kOvershoot * relief->blend_m;
    if (!filleted) return least_m;
    constexpr float kFillet = static_cast<float>(kFilletOvershoot);
    return least_m + std::min(kOvershoot * parameters.blend_m, kFillet * parameters.slack_m);
  }
};

/// Target beyond the clearance by the error of the closest point, so that its ellipsoid need not be evaluated
/// again. `owner` may be -1.
HWY_INLINE V plain_target(const Surface& surface, VI owner) {
  constexpr int kStride = kBakedFloats;
  const VI at = hn::Mul(hn::Max(owner, hn::Zero(I())), hn::Set(I(), kStride));
  const V longest = hn::GatherIndex(f, &surface.baked.ellipsoids.data()->longest_m, at);
  const float clearance_m = surface.parameters.clearance_m;
  return hn::MulAdd(all(kSolverError), hn::Add(longest, all(std::max(0.0f, clearance_m))),
                    all(surface.target_m()));
}

/// Evaluates the smooth union at all positions of the batch.
HWY_INLINE void measure_filleted(const Surface& surface, const QueryBatch& batch, BatchResults& out) {
  const ResponseParameters& c = surface.parameters;
  for (int i = 0; i < batch.count; i += kWidth) {
    const V3 p = load3(batch.x + i, batch.y + i, batch.z + i);
    const Sample s =
        smooth_distance(surface.baked, c.blend_m, *surface.filleted, p, all(c.clearance_m + c.blend_m));
    hn::Store(s.distance, f, out.distance + i);
    hn::Store(hn::Sqrt(dot(s.gradient, s.gradient)), f, out.value + i);
    store3(unit(s.gradient), out.gx + i, out.gy + i, out.gz + i);
    const VI owner = hn::Max(s.owner, hn::Zero(I()));
    hn::Store(hn::GatherIndex(I(), surface.baked.proxy_index.data(), owner), I(), out.proxy_index + i);
  }
}

/// Distance, unit gradient, its length and the owner at each position; false on overflow.
HWY_INLINE bool measure(const Surface& surface, QueryBatch& batch, BatchResults& out) {
  if (!surface.filleted) return nearest(surface.baked, surface.relief, batch, surface.scratch, out);
  measure_filleted(surface, batch, out);
  return true;
}

/// Takes every particle of the batch.
HWY_INLINE void take_all(const QueryBatch& batch, InRange& out) {
  out.count = (batch.count + kStep - 1) / kStep * kStep;
  for (int i = 0; i < out.count; i += kWidth) {
    const auto there = hn::RebindMask(I(), lanes_below(i, batch.count));
    store3({hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)}, out.x + i,
           out.y + i, out.z + i);
    hn::Store(hn::IfThenElse(there, lanes_from(i), hn::Set(I(), -1)), I(), out.lane + i);
  }
}

/// Evaluates the initial positions of all particles that may be below the clearance; false on overflow.
HWY_INLINE bool measure_first(const Surface& surface, QueryBatch& batch, InRange& in_range,
                              BatchResults& out) {
  const float limit_m = surface.parameters.clearance_m;
  if (!surface.filleted &&
      nearest_in_range(surface.baked, surface.relief, batch, limit_m, surface.scratch, in_range, out))
    return true;
  take_all(batch, in_range);
  if (surface.nonconvex()) return measure(surface, batch, out);
  // The ellipsoids near the batch overflowed the lists.
  alignas(64) std::int32_t none[kBatch];
  std::memset(none, 0xFF, sizeof(none));
  const ClearedPositions cleared{batch, none, none, none};
  return nearest_others(surface.baked, cleared, limit_m, surface.scratch, out);
}

/// Evaluates the current positions; with plain ellipsoids only where one is below the clearance. False on
/// overflow.
HWY_INLINE bool measure_again(const Surface& surface, const PushedLanes& pushed, BatchResults& out) {
  QueryBatch batch = batch_at(pushed.x, pushed.y, pushed.z, pushed.count);
  if (surface.nonconvex()) return measure(surface, batch, out);
  const ClearedPositions cleared{batch, pushed.clear1, pushed.clear2, pushed.clear3};
  return nearest_others(surface.baked, cleared, surface.parameters.clearance_m, surface.scratch, out);
}

/// Newton's step to the target, given F, its unit gradient and the gradient's length.
HWY_INLINE V3 newton_step(V3 x, V distance, V3 normal, V slope, V target) {
  return add_scaled(x, hn::Mul(hn::Sub(target, distance), reciprocal(hn::Max(slope, all(0.5f)))), normal);
}

/// The first and the latest active plane of the lanes `at`; the latest only where `two`.
struct ActivePlanes {
  Plane first, latest;
  VI latest_ellipsoid;
  M two;
};

/// Reads the active planes. Most particles are pushed into a second ellipsoid and few into a third, so that
/// the second and third planes are read only if some lane has them.
HWY_INLINE ActivePlanes active_planes(const PushState& state, VI at) {
  const VI none = hn::Set(I(), -1);
  const Plane first = {gather3(state.n1x, state.n1y, state.n1z, at), hn::GatherIndex(f, state.offset1, at)};
  const VI ellipsoid2 = hn::GatherIndex(I(), state.ellipsoid2, at);
  const M two = hn::RebindMask(f, hn::Gt(ellipsoid2, none));
  if (hn::AllFalse(f, two)) return {first, first, none, two};
  const VI ellipsoid3 = hn::GatherIndex(I(), state.ellipsoid3, at);
  const M three = hn::RebindMask(f, hn::Gt(ellipsoid3, none));
  const Plane latest = {
      select(three, gather3(state.n3x, state.n3y, state.n3z, at),
             gather3(state.n2x, state.n2y, state.n2z, at)),
      hn::IfThenElse(three, hn::GatherIndex(f, state.offset3, at), hn::GatherIndex(f, state.offset2, at))};
  return {first, latest, hn::IfThenElse(hn::RebindMask(I(), three), ellipsoid3, ellipsoid2), two};
}

/// Adds a plane for the lanes `which`, at indices `at` (zero elsewhere), and moves to the closest point in
/// its half-space and those of the active planes. Of these the first and the latest stay active.
HWY_INLINE Push add_plane(const Surface& surface, M which, VI at, const Plane& newest, VI newest_ellipsoid,
                          const InRange& in_range, PushState& state) {
  const V slack = all(surface.parameters.slack_m);
  const VI none = hn::Set(I(), -1);
  const auto [first, latest, latest_ellipsoid, two] = active_planes(state, at);
  const M third = hn::And(two, which);
  const V3 p = gather3(in_range.x, in_range.y, in_range.z, at);
  V3 next = project(first, newest, hn::FirstN(f, kWidth), p);
  V behind = hn::Max(first.gap(next), newest.gap(next));
  const Scatter scatter(which, at);
  const auto put_second = [&](const Plane& plane, VI of) {
    scatter.store(plane.n, state.n2x, state.n2y, state.n2z);
    scatter.store(plane.offset, state.offset2);
    scatter.store(of, state.ellipsoid2);
  };
  VI clear3 = none;
  if (hn::AllFalse(f, third)) {
    put_second(newest, newest_ellipsoid);
  } else {
    next = select(two, project(first, latest, newest, p, slack), next);
    put_second({select(two, latest.n, newest.n), hn::IfThenElse(two, latest.offset, newest.offset)},
               hn::IfThenElse(hn::RebindMask(I(), two), latest_ellipsoid, newest_ellipsoid));
    const Scatter scatter_third(third, at);
    scatter_third.store(newest.n, state.n3x, state.n3y, state.n3z);
    scatter_third.store(newest.offset, state.offset3);
    scatter_third.store(newest_ellipsoid, state.ellipsoid3);
    behind = hn::Max(hn::Max(first.gap(next), newest.gap(next)),
                     hn::IfThenElse(two, latest.gap(next), all(-1e30f)));
    clear3 = hn::IfThenElse(hn::RebindMask(I(), two), latest_ellipsoid, none);
  }
  scatter.store(next, state.x, state.y, state.z);
  // Nearly parallel planes meet far away, if at all: then every ellipsoid is evaluated again.
  const auto certain = hn::RebindMask(I(), hn::Le(behind, slack));
  return {next, hn::IfThenElse(certain, hn::GatherIndex(I(), state.owner, at), none),
          hn::IfThenElse(certain, newest_ellipsoid, none), hn::IfThenElse(certain, clear3, none)};
}

/// Pushes one vector of the particles that the last evaluation found below the clearance, from the i-th on.
/// They are closed up: each moves to its old index in `pushed` or to a lower one.
HWY_INLINE void push_again(const Surface& surface, const InRange& in_range, const BatchResults& found,
                           const LanesBelow& below, int i, PushedLanes& pushed, PushState& state) {
  const M which = lanes_below(i, below.count);
  const auto real = hn::RebindMask(I(), which);
  const VI at = hn::IfThenElseZero(real, hn::Load(I(), below.at + i));
  const VI lane = hn::IfThenElseZero(real, hn::Load(I(), below.lane + i));
  const V distance = hn::GatherIndex(f, found.distance, at);
  const V3 normal = gather3(found.gx, found.gy, found.gz, at);
  const V3 x = gather3(pushed.x, pushed.y, pushed.z, at);
  if (surface.nonconvex()) {
    const V slope = hn::GatherIndex(f, found.value, at);
    const V3 next = newton_step(x, distance, normal, slope, all(surface.target_m()));
    Scatter(which, lane).store(next, state.x, state.y, state.z);
    const VI none = hn::Set(I(), -1);
    return pushed.put({next, none, none, none}, i);
  }
  const VI proxy_index = hn::GatherIndex(I(), found.proxy_index, at);
  const VI newest = hn::GatherIndex(I(), surface.baked.internal_index.data(), proxy_index);
  const V offset = hn::Add(dot(normal, x), hn::Sub(plain_target(surface, newest), distance));
  pushed.put(add_plane(surface, which, lane, {normal, offset}, newest, in_range, state), i);
}

/// Velocities are corrected by the last normal of a nonconvex surface, so it is stored.
HWY_INLINE void store_normals(const PushedLanes& pushed, const BatchResults& found, PushState& state) {
  for (int i = 0; i < pushed.count; ++i) {
    const int lane = pushed.lane[i];
    state.n1x[lane] = found.gx[i];
    state.n1y[lane] = found.gy[i];
    state.n1z[lane] = found.gz[i];
  }
}

/// Pushes the lanes of `pushed` again, after their first push, until all are clear; false on overflow.
HWY_INLINE bool push_until_clear(const Surface& surface, const InRange& in_range, bool has_velocity,
                                 PushedLanes& pushed, PushState& state) {
  const auto most = static_cast<std::uint32_t>(surface.nonconvex() ? kReliefRounds : kPlainRounds);
  BatchResults found;
  pushed.close();
  // On relief the first push reaches the surface, and the later ones only correct it.
  surface.scratch.lists.room_m = surface.relief ? surface.relief->blend_m : 0.0f;
  for (state.rounds = 0; pushed.count > 0 && state.rounds < most; ++state.rounds) {
    if (!measure_again(surface, pushed, found)) return false;
    if (surface.nonconvex() && has_velocity) store_normals(pushed, found, state);
    const LanesBelow below(found.distance, surface.parameters.clearance_m, pushed);
    for (int i = 0; i < below.count; i += kWidth)
      push_again(surface, in_range, found, below, i, pushed, state);
    pushed.close(below);
  }
  for (int i = 0; i < pushed.count; ++i) state.open.add(1, pushed.lane[i]);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
