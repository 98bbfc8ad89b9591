// Pushes particles until none is below the clearance. Plain ellipsoids are convex: each one that a position
// violates adds the half-space beyond its tangent plane, and a point in all half-spaces is clear of those
// ellipsoids. On relief and fillets this becomes Newton's method along the gradient.
#if defined(BODICE_COLLISION_CUTTING_PLANES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CUTTING_PLANES_INL_
#undef BODICE_COLLISION_CUTTING_PLANES_INL_
#else
#define BODICE_COLLISION_CUTTING_PLANES_INL_
#endif

#include "model/fallback.hpp"
#include "simd/math/planes-inl.hpp"
#include "simd/narrow/pairs-inl.hpp"
#include "simd/response/push_state-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr int kPlainRounds = 6;
constexpr int kNonconvexRounds = 6;

/// Newton's step to the target, given F, its unit gradient and the gradient's length.
HWY_INLINE V3 newton_step(V3 x, V distance, V3 normal, V slope, V target) {
  return add_scaled(x, hn::Mul(hn::Sub(target, distance), reciprocal(hn::Max(slope, all(0.5f)))), normal);
}

/// The first and the latest active plane of some particles; the latest only where `two`.
struct ActivePlanes {
  Plane first, latest;
  VI latest_ellipsoid;
  M two;
};

/// Reads the active planes of the particles `at`. Most particles are pushed into a second ellipsoid and few
/// into a third, so that the second and third planes are read only if some lane has them.
HWY_INLINE ActivePlanes active_planes(const PushState& state, VI at) {
  const auto& [plane1, plane2, plane3] = state.plane;
  const VI none = hn::Set(I(), -1);
  const Plane first = plane1.gather(at);
  const VI ellipsoid2 = plane2.ellipsoids(at);
  const M two = hn::RebindMask(f, hn::Gt(ellipsoid2, none));
  if (hn::AllFalse(f, two)) return {first, first, none, two};
  const VI ellipsoid3 = plane3.ellipsoids(at);
  const M three = hn::RebindMask(f, hn::Gt(ellipsoid3, none));
  const Plane latest = {
      select(three, plane3.gather_normal(at), plane2.gather_normal(at)),
      hn::IfThenElse(three, hn::GatherIndex(f, plane3.offset, at), hn::GatherIndex(f, plane2.offset, at))};
  return {first, latest, hn::IfThenElse(hn::RebindMask(I(), three), ellipsoid3, ellipsoid2), two};
}

/// The pushes after the first one, until all particles of a batch are clear. Surface is a policy of
/// surface-inl.hpp.
template <class Surface>
class CuttingPlanes {
 public:
  HWY_INLINE CuttingPlanes(Surface& surface, const InRange& in_range, PushedLanes& pushed, PushState& state)
      : surface_(surface), in_range_(in_range), pushed_(pushed), state_(state) {}

  /// Pushes the lanes of `pushed` again until all are clear or kPlainRounds are over; kTooMany on overflow.
  HWY_INLINE Status push_until_clear(bool has_velocity);

 private:
  /// Adds a plane for the lanes `which`, at indices `at` (zero elsewhere), and moves to the closest point in
  /// its half-space and those of the active planes. Of these the first and the latest stay active.
  HWY_INLINE Push add_plane(M which, VI at, const Plane& newest, VI newest_ellipsoid);
  /// Pushes one vector of the particles that the last evaluation found below the clearance, from the i-th on.
  /// They are closed up: each moves to its old index in `pushed` or to a lower one.
  HWY_INLINE void push_again(const BatchResults& found, const LanesBelow& below, int i);
  /// Velocities are corrected by the last normal of a nonconvex surface, so it is stored.
  HWY_INLINE void store_normals(const BatchResults& found);

  Surface& surface_;
  const InRange& in_range_;
  PushedLanes& pushed_;
  PushState& state_;
};

template <class Surface>
HWY_INLINE Push CuttingPlanes<Surface>::add_plane(M which, VI at, const Plane& newest, VI newest_ellipsoid) {
  const V slack = all(surface_.parameters.slack_m);
  const VI none = hn::Set(I(), -1);
  const auto [first, latest, latest_ellipsoid, two] = active_planes(state_, at);
  const M third = hn::And(two, which);
  const V3 p = gather3(in_range_.x, in_range_.y, in_range_.z, at);
  V3 next = project(first, newest, hn::FirstN(f, kWidth), p);
  V behind = hn::Max(first.gap(next), newest.gap(next));
  const Scatter scatter(which, at);
  VI clear3 = none;
  if (hn::AllFalse(f, third)) {
    scatter.store(newest, newest_ellipsoid, state_.plane[1]);
  } else {
    next = select(two, project(first, latest, newest, p, slack), next);
    scatter.store({select(two, latest.n, newest.n), hn::IfThenElse(two, latest.offset, newest.offset)},
                  hn::IfThenElse(hn::RebindMask(I(), two), latest_ellipsoid, newest_ellipsoid),
                  state_.plane[1]);
    Scatter(third, at).store(newest, newest_ellipsoid, state_.plane[2]);
    behind = hn::Max(hn::Max(first.gap(next), newest.gap(next)),
                     hn::IfThenElse(two, latest.gap(next), all(-1e30f)));
    clear3 = hn::IfThenElse(hn::RebindMask(I(), two), latest_ellipsoid, none);
  }
  scatter.store(next, state_.x, state_.y, state_.z);
  // Nearly parallel planes meet far away, if at all: then every ellipsoid is evaluated again.
  const auto certain = hn::RebindMask(I(), hn::Le(behind, slack));
  return {next, hn::IfThenElse(certain, state_.plane[0].ellipsoids(at), none),
          hn::IfThenElse(certain, newest_ellipsoid, none), hn::IfThenElse(certain, clear3, none)};
}

template <class Surface>
HWY_INLINE void CuttingPlanes<Surface>::push_again(const BatchResults& found, const LanesBelow& below,
                                                   int i) {
  const M which = lanes_below(i, below.count);
  const auto real = hn::RebindMask(I(), which);
  const VI at = hn::IfThenElseZero(real, hn::Load(I(), below.at + i));
  const VI lane = hn::IfThenElseZero(real, hn::Load(I(), below.lane + i));
  const V distance = hn::GatherIndex(f, found.distance, at);
  const V3 normal = gather3(found.gx, found.gy, found.gz, at);
  const V3 x = gather3(pushed_.x, pushed_.y, pushed_.z, at);
  if constexpr (Surface::kConvex) {
    const VI proxy_index = hn::GatherIndex(I(), found.proxy_index, at);
    const VI newest = hn::GatherIndex(I(), surface_.baked().internal_index.data(), proxy_index);
    const V offset = hn::Add(dot(normal, x), hn::Sub(surface_.target(newest), distance));
    pushed_.put(add_plane(which, lane, {normal, offset}, newest), i);
  } else {
    const V slope = hn::GatherIndex(f, found.value, at);
    const VI none = hn::Set(I(), -1);
    const V3 next = newton_step(x, distance, normal, slope, surface_.target(none));
    Scatter(which, lane).store(next, state_.x, state_.y, state_.z);
    pushed_.put({next, none, none, none}, i);
  }
}

template <class Surface>
HWY_INLINE void CuttingPlanes<Surface>::store_normals(const BatchResults& found) {
  for (int i = 0; i < pushed_.count; ++i) {
    const int lane = pushed_.lane[i];
    state_.plane[0].nx[lane] = found.gx[i];
    state_.plane[0].ny[lane] = found.gy[i];
    state_.plane[0].nz[lane] = found.gz[i];
  }
}

template <class Surface>
HWY_INLINE Status CuttingPlanes<Surface>::push_until_clear(bool has_velocity) {
  constexpr std::uint32_t kRounds = Surface::kConvex ? kPlainRounds : kNonconvexRounds;
  BatchResults found;
  pushed_.close();
  for (state_.rounds = 0; pushed_.count > 0 && state_.rounds < kRounds; ++state_.rounds) {
    const Status status = surface_.measure_again(pushed_, found);
    if (status != Status::kDone) return status;
    if (!Surface::kConvex && has_velocity) store_normals(found);
    const LanesBelow below(found.distance, surface_.parameters.clearance_m, pushed_);
    for (int i = 0; i < below.count; i += kWidth) push_again(found, below, i);
    pushed_.close(below);
  }
  for (int i = 0; i < pushed_.count; ++i) state_.open.add(1, pushed_.lane[i]);
  return Status::kDone;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
