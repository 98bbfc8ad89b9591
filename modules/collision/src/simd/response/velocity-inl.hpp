// Velocities after a contact, and the motion of the body's material.
#if defined(BODICE_COLLISION_VELOCITY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_VELOCITY_INL_
#undef BODICE_COLLISION_VELOCITY_INL_
#else
#define BODICE_COLLISION_VELOCITY_INL_
#endif

#include <algorithm>

#include "model/batch.hpp"
#include "simd/math/planes-inl.hpp"
#include "simd/response/push_state-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// A plane of the contact at x, active only if x lies on it. Elsewhere its normal is zero, so that it does
/// not restrict velocities.
HWY_INLINE Plane touching(const Plane& plane, M active, V3 x, float within_m, M& there) {
  there = hn::And(active, hn::Ge(plane.gap(x), all(-within_m)));
  const V zero = hn::Zero(f);
  return {select(there, plane.n, {zero, zero, zero}), zero};
}

/// The closest velocity that leads into none of the contact's planes at x, the position of lane i. Even the
/// first plane may have been left behind.
HWY_INLINE V3 closest_velocity(const PushState& state, int i, V3 x, float within_m, V3 v) {
  M one, two, three;
  const auto& [plane1, plane2, plane3] = state.plane;
  const Plane first = touching(plane1.at(i), hn::FirstN(f, kWidth), x, within_m, one);
  const Plane second = touching(plane2.at(i), plane2.active(i), x, within_m, two);
  const Plane third = touching(plane3.at(i), plane3.active(i), x, within_m, three);
  const V3 of_two = project(first, second, two, v);
  if (hn::AllFalse(f, three)) return of_two;
  const V zero = hn::Zero(f);
  const V3 of_other = project(first, third, three, v);
  const V3 of_three = select(hn::Le(third.gap(of_two), zero), of_two, project(first, second, third, v, zero));
  return select(three, select(two, of_three, of_other), of_two);
}

/// The closest velocity that does not lead behind the tangent plane with normal n.
HWY_INLINE V3 closest_velocity(V3 n, V3 v) {
  return add_scaled(v, hn::Max(hn::Neg(dot(n, v)), hn::Zero(f)), n);
}

/// Removes the inward velocity and slows the rest by Coulomb friction; restitution is 0.
HWY_INLINE V3 corrected_velocity(V3 along_surface, float friction, V3 v) {
  const V3 change = along_surface - v;
  const V impulse2 = dot(change, change), speed2 = dot(along_surface, along_surface);
  const V ratio = hn::Sqrt(hn::Div(impulse2, hn::Max(speed2, all(1e-30f))));
  return scaled(along_surface, hn::Max(hn::Zero(f), hn::NegMulAdd(all(friction), ratio, all(1.0f))));
}

/// Velocity of the body's material at x, moving with ellipsoid `owner`; lanes without an owner read the first
/// ellipsoid.
HWY_INLINE V3 surface_velocity(const SurfaceMotion* motion, VI owner, V3 x) {
  constexpr int kStride = sizeof(SurfaceMotion) / sizeof(float);
  const VI at = hn::Mul(hn::Max(owner, hn::Zero(I())), hn::Set(I(), kStride));
  const float* base = motion->linear;  // linear, then translation, without padding
  const V3 r0 = {hn::GatherIndex(f, base, at), hn::GatherIndex(f, base + 1, at),
                 hn::GatherIndex(f, base + 2, at)};
  const V3 r1 = {hn::GatherIndex(f, base + 3, at), hn::GatherIndex(f, base + 4, at),
                 hn::GatherIndex(f, base + 5, at)};
  const V3 r2 = {hn::GatherIndex(f, base + 6, at), hn::GatherIndex(f, base + 7, at),
                 hn::GatherIndex(f, base + 8, at)};
  const V3 translation = {hn::GatherIndex(f, base + 9, at), hn::GatherIndex(f, base + 10, at),
                          hn::GatherIndex(f, base + 11, at)};
  return V3{dot(r0, x), dot(r1, x), dot(r2, x)} + translation;
}

/// The displacement of the material of an ellipsoid at p since the safe positions. Precondition: the body
/// moves.
HWY_INLINE V3 carried(const ResponseParameters& parameters, V3 p, VI owner) {
  return scaled(surface_velocity(parameters.motion, owner, p), all(parameters.dt_s));
}

/// Paths longer than the limit, relative to the ellipsoid that owns the particle. Without an owner any
/// ellipsoid may have passed by, so that the limit is reduced by the body's displacement.
HWY_INLINE M long_paths(V3 path, const ResponseParameters& parameters, V3 p, VI owner, float limit_m) {
  V limit = all(limit_m);
  if (parameters.motion) {
    const M owned = hn::RebindMask(f, hn::Gt(owner, hn::Set(I(), -1)));
    path = select(owned, path - carried(parameters, p, owner), path);
    limit = hn::IfThenElse(owned, limit, all(std::max(0.0f, limit_m - parameters.travel_m)));
  }
  return hn::Ge(dot(path, path), hn::Mul(limit, limit));
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
