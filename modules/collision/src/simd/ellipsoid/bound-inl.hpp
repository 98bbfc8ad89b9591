// A lower bound of the distance to an ellipsoid at a seventh of the closest's cost.
// With k0 = |diag(1/r) R^T (p - c)|, a convex function of p that is 1 on the surface, and k1 / k0 = |grad
// k0|: k0 at the closest is at least k0(p) + grad k0 . (closest - p), so that the distance outside is at
// least (k0
// - 1) k0 / k1; inside, a step of (1 - k0) k0 / k1 along the gradient reaches k0 >= 1, so that the depth is
// at most that. CandidateList the surface it is the distance to first order.
// By the same inequality the ellipsoid lies behind the plane at L along the gradient from q, which bounds the
// distance from below everywhere: d(p) >= L(q) + m(q) . (p - q), m the unit gradient.
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

// So close to the center, in radii, the bound is only made to stay finite and low enough.
constexpr float kLeastSquare = 1e-20f, kLeastSlope2 = 1e-37f;

/// Where a vector of points is when the ellipsoid is the unit ball.
HWY_INLINE V3 in_ball(const BallMap& e, V3 p) {
  const auto row = [&](const float* a, float offset) {
    return hn::MulAdd(all(a[0]), p.x, hn::MulAdd(all(a[1]), p.y, hn::MulAdd(all(a[2]), p.z, all(offset))));
  };
  return {row(e.to_ball, e.offset[0]), row(e.to_ball + 3, e.offset[1]), row(e.to_ball + 6, e.offset[2])};
}

/// The square of k1 at such a place.
HWY_INLINE V slope_square(const BallMap& e, V3 u) {
  const V3 v = {hn::Mul(u.x, all(e.inverse_radius[0])), hn::Mul(u.y, all(e.inverse_radius[1])),
                hn::Mul(u.z, all(e.inverse_radius[2]))};
  return dot(v, v);
}

// The estimate of 1 / k0 is off by a share of it, as if the ellipsoid were larger by that.
static_assert(kBoundGrowth > kEstimate);

/// L there, meters: of Baked::bounds not above that of the ellipsoid itself by more than twice the share
/// kEstimate of it. Never NaN or infinite.
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
