// The closest point of the intersection of two or three half-spaces, one problem a lane.
#if defined(BODICE_COLLISION_PLANES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_PLANES_INL_
#undef BODICE_COLLISION_PLANES_INL_
#else
#define BODICE_COLLISION_PLANES_INL_
#endif

#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr float kLeastVolume = 1e-3f;  // of three unit normals; with less their planes meet far away

/// The half-space { x : n . x >= offset }; gap() is positive where x violates it.
struct Plane {
  V3 n;
  V offset;

  HWY_INLINE V gap(V3 x) const { return hn::Sub(offset, dot(n, x)); }
};

/// The closest point to p in both half-spaces, the second only where `two`, by the four cases of the
/// optimality conditions.
HWY_INLINE V3 project(const Plane& a, const Plane& b, M two, V3 p) {
  const V zero = hn::Zero(f);
  const V missing_a = a.gap(p), missing_b = hn::IfThenElse(two, b.gap(p), all(-1e30f));
  const V cosine = hn::IfThenElse(two, dot(a.n, b.n), zero);
  const V sine2 = hn::Max(hn::NegMulAdd(cosine, cosine, all(1.0f)), all(1e-6f));
  const V rest_a = hn::NegMulAdd(cosine, missing_b, missing_a);
  const V rest_b = hn::NegMulAdd(cosine, missing_a, missing_b);
  const M both = hn::And(hn::Gt(rest_a, zero), hn::Gt(rest_b, zero));
  const M only_a = hn::And(hn::Gt(missing_a, zero), hn::Le(rest_b, zero));
  const V alone_a = hn::IfThenElseZero(only_a, missing_a);
  const V alone_b = hn::IfThenElse(only_a, zero, hn::Max(missing_b, zero));
  const V push_a = hn::IfThenElse(both, hn::Div(rest_a, sine2), alone_a);
  const V push_b = hn::IfThenElse(both, hn::Div(rest_b, sine2), alone_b);
  return add_scaled(add_scaled(p, push_a, a.n), push_b, b.n);
}

HWY_INLINE V3 cross(V3 a, V3 b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// The closest point to p in three half-spaces, where the first two alone do not suffice. It is that of the
/// third and one of the others if it lies in the remaining one, otherwise the corner of all three planes.
HWY_INLINE V3 project(const Plane& a, const Plane& b, const Plane& c, V3 p, V slack) {
  const M all_lanes = hn::FirstN(f, kWidth);
  const V3 ac = project(a, c, all_lanes, p);
  const V3 bc = project(b, c, all_lanes, p);
  const V3 bxc = cross(b.n, c.n), cxa = cross(c.n, a.n), axb = cross(a.n, b.n);
  const V volume = dot(a.n, bxc);
  const M flat = hn::Lt(hn::Abs(volume), all(kLeastVolume));
  const V inverse = hn::Div(all(1.0f), hn::IfThenElse(flat, all(kLeastVolume), volume));
  const V3 sum = add_scaled(add_scaled(scaled(bxc, a.gap(p)), b.gap(p), cxa), c.gap(p), axb);
  const V3 corner = add_scaled(p, inverse, sum);
  return select(hn::Le(b.gap(ac), slack), ac, select(hn::Le(a.gap(bc), slack), bc, corner));
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
