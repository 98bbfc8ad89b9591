// A lower bound on the distance to an ellipsoid, at a seventh of the closest point's cost:
//   [1] k0(p) = |diag(1/r) R^T (p - c)|, convex in p and 1 on the surface
//   [2] |grad k0| = k1 / k0, k1 = |diag(1/r)^2 R^T (p - c)|
//   [3] L(p) = (k0 - 1) k0 / k1
// Outside, convexity gives 1 = k0(f) >= k0(p) + grad k0 . (f - p) for the closest point f, so that the
// distance is at least L. Inside, a step of -L along the gradient reaches k0 >= 1, so that the depth is at
// most -L. Near the surface L is the distance to first order.
// By the same inequality the ellipsoid lies behind the plane at L along the gradient from q, which bounds the
// distance everywhere: d(p) >= L(q) + m(q) . (p - q), m the unit gradient.
#if defined(BODICE_COLLISION_BOUND_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_BOUND_INL_
#undef BODICE_COLLISION_BOUND_INL_
#else
#define BODICE_COLLISION_BOUND_INL_
#endif

#include "model/baked.hpp"
#include "model/tolerances.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

// Nearer to the center than this (in radii) the bound is only kept finite and low enough.
constexpr float kLeastSquare = 1e-20f, kLeastSlope2 = 1e-37f;

/// The points p in the frame in which the ellipsoid is the unit ball.
HWY_INLINE V3 in_ball(const BallMap& e, V3 p) {
  const auto row = [&](const float* a, float offset) {
    return hn::MulAdd(all(a[0]), p.x, hn::MulAdd(all(a[1]), p.y, hn::MulAdd(all(a[2]), p.z, all(offset))));
  };
  return {row(e.to_ball, e.offset[0]), row(e.to_ball + 3, e.offset[1]), row(e.to_ball + 6, e.offset[2])};
}

/// The square of k1 in [2], for such points.
HWY_INLINE V slope_square(const BallMap& e, V3 u) {
  const V3 v = {hn::Mul(u.x, all(e.inverse_radius[0])), hn::Mul(u.y, all(e.inverse_radius[1])),
                hn::Mul(u.z, all(e.inverse_radius[2]))};
  return dot(v, v);
}

// An error in the estimate of 1 / k0 has the effect of an ellipsoid that is larger by the same factor.
static_assert(kBoundGrowth > kEstimate);

/// L of [3] there, meters. For a map of Baked::bounds it exceeds the ellipsoid's own L by at most 2 kEstimate
/// of it. It is never NaN or infinite.
HWY_INLINE V bound_in_ball(const BallMap& e, V3 u) {
  const V square = hn::Max(dot(u, u), all(kLeastSquare));
  const V excess = hn::NegMulAdd(square, estimated_inverse_sqrt(square), square);
  return hn::Mul(excess, estimated_inverse_sqrt(hn::Max(slope_square(e, u), all(kLeastSlope2))));
}

HWY_INLINE V lower_bound(const BallMap& e, V3 p) {
  return bound_in_ball(e, in_ball(e, p));
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
