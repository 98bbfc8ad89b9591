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

#include "model/batch.hpp"
#include "model/proxy_model.hpp"
#include "model/tolerances.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr float kNoLimit_m = 1e30f;

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

/// The numbers of BallMap, a different ellipsoid in each lane.
struct BallLanes {
  V3 a0, a1, a2, offset, inverse_radius;
};

/// `row` reads the members of BallMap by their index.
template <class Row>
HWY_INLINE BallLanes ball_lanes(Row&& row) {
  const auto row3 = [&](int i) { return V3{row(i), row(i + 1), row(i + 2)}; };
  return {row3(0), row3(3), row3(6), row3(kBallOffset), row3(kBallInverse)};
}

/// The points p in the frames in which the ellipsoids are unit balls.
HWY_INLINE V3 in_ball(const BallLanes& e, V3 p) {
  const auto row = [&](V3 a, V offset) {
    return hn::MulAdd(a.x, p.x, hn::MulAdd(a.y, p.y, hn::MulAdd(a.z, p.z, offset)));
  };
  return {row(e.a0, e.offset.x), row(e.a1, e.offset.y), row(e.a2, e.offset.z)};
}

constexpr std::int32_t kRankMask = kMaxCandidates - 1;
static_assert((kMaxCandidates & kRankMask) == 0, "a rank must fit into the low bits of a bound");
// The rank changes a bound by far less than kEstimate.
static_assert(kMaxCandidates <= 256);

/// A bound that carries its candidate's rank in its low bits.
HWY_INLINE V ranked(V bound, VI rank) {
  return hn::BitCast(f, hn::Or(hn::AndNot(hn::Set(I(), kRankMask), hn::BitCast(I(), bound)), rank));
}

/// The kLowest lowest bounds of each lane, rising, with their candidates' ranks in the low bits. The value
/// after them shows whether they are all that count.
template <int kLowest>
struct LowestBounds {
  V bound[kLowest + 1];

  HWY_INLINE void clear() {
    for (V& b : bound) b = hn::BitCast(f, hn::Set(I(), 0x71490000));  // 1e30 with rank 0
  }
  HWY_INLINE void add(V value, VI rank) {
    V next = ranked(value, rank);
    for (int i = 0; i < kLowest; ++i) {
      const V higher = hn::Max(bound[i], next);
      bound[i] = hn::Min(bound[i], next);
      next = higher;
    }
    bound[kLowest] = hn::Min(bound[kLowest], next);
  }
  HWY_INLINE VI rank(int i) const { return hn::And(hn::BitCast(I(), bound[i]), hn::Set(I(), kRankMask)); }
};

/// Bound above which an ellipsoid is certainly farther than `distance` by more than `beyond_m`. A bound may
/// be too high by a fraction of itself, a distance by the rounding.
HWY_INLINE V bound_limit(const Baked& baked, V distance, float beyond_m) {
  const V slack = all(4.0f * baked.rounding_m + beyond_m);
  return hn::Add(hn::MulAdd(all(2.0f * kEstimate), hn::Abs(distance), distance), slack);
}

/// The contact distance as a limit on corrected distances, and as a limit on distances to plain ellipsoids.
struct QueryLimits {
  float surface_m, plain_m;

  HWY_INLINE QueryLimits(const ProxyModel& model, float limit_m)
      : surface_m(limit_m + 4.0f * model.baked.rounding_m), plain_m(surface_m) {
    if (!model.relief) return;
    plain_m = model.relief->farthest.at_zero_m[0] + model.relief->farthest.shift_m(surface_m);
  }
  /// The limit on bounds.
  HWY_INLINE float of_bounds(const Baked& baked) const {
    return hn::GetLane(bound_limit(baked, all(plain_m), 0.0f));
  }
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
