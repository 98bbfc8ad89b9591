// The proxy's distance to first order at every particle of a batch. The owner is the ellipsoid of least
// first-order distance; the contact lies on its tangent plane at the point to which one Newton step leads.
// The exact closest point takes twice as long, and certainty about the owner as long again.
// Based on: Gabriel Taubin. Distance Approximations for Rasterizing Implicit Curves. ACM TOG 13(1), 1994, for
// the first-order distance (|u|^2 - 1) / |grad |u|^2|, where u is the particle in the frame in which the
// ellipsoid is the unit ball.
#if defined(BODICE_COLLISION_FIRST_ORDER_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_FIRST_ORDER_INL_
#undef BODICE_COLLISION_FIRST_ORDER_INL_
#else
#define BODICE_COLLISION_FIRST_ORDER_INL_
#endif

#include "simd/broad/cached_candidates-inl.hpp"
#include "simd/broad/limits-inl.hpp"
#include "simd/ellipsoid/relief_table-inl.hpp"
#include "simd/narrow/contacts-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr float kMostSlope2 = 1e37f;

HWY_INLINE V within_range(V slope2) {
  return hn::Min(hn::Max(slope2, all(kLeastSlope2)), all(kMostSlope2));
}

/// Twice the first-order distance to one ellipsoid, meters, with relative error kEstimate. It does not exceed
/// lower_bound(), needs one estimated root less, and finds the nearest ellipsoid slightly more often.
HWY_INLINE V twice_first_order(const BallMap& e, V3 p) {
  const V3 u = in_ball(e, p);
  const V excess = hn::MulAdd(u.x, u.x, hn::MulAdd(u.y, u.y, hn::MulSub(u.z, u.z, all(1.0f))));
  return hn::Mul(excess, estimated_inverse_sqrt(within_range(slope_square(e, u))));
}

/// Tangent plane of an ellipsoid, one problem a lane.
struct Tangent {
  V distance;  ///< of the particle, meters; at most the distance to the ellipsoid, but for rounding
  V3 normal;   ///< outward, unit, local frame
  V3 w;        ///< point of contact as a direction on the unit sphere, axes of the proxy
  V3 shrink;   ///< r_j^2 / (t + r_j^2), with t after one step
};

/// The unit vector along the shortest axis; of equal axes along the last.
HWY_INLINE V3 shortest_axis(const BallLanes& e) {
  const V3 i = e.inverse_radius;
  const V one = all(1.0f);
  const M z = hn::Ge(i.z, hn::Max(i.x, i.y)), y = hn::AndNot(z, hn::Ge(i.y, i.x));
  return {hn::IfThenElseZero(hn::Not(hn::Or(z, y)), one), hn::IfThenElseZero(y, one),
          hn::IfThenElseZero(z, one)};
}

/// The quotients r_j^2 / (t + r_j^2) to first order, t by one step on |w|^2 from the surface, where t = 0.
HWY_INLINE V3 shrink_of(const BallLanes& e, V3 u, V square) {
  const V3 i = e.inverse_radius;
  const V3 v = {hn::Mul(u.x, i.x), hn::Mul(u.y, i.y), hn::Mul(u.z, i.z)};
  const V excess = hn::Mul(all(0.5f), hn::Sub(square, all(1.0f)));
  const V t = hn::Mul(excess, estimated_reciprocal(within_range(dot(v, v))));
  const auto quotient = [&](V inverse) {
    return hn::Max(hn::Zero(f), hn::NegMulAdd(hn::Mul(t, inverse), inverse, all(1.0f)));
  };
  return {quotient(i.x), quotient(i.y), quotient(i.z)};
}

/// Tangent planes in the direction w = diag(r / (t + r^2)) y of the closest point. For any unit vector w the
/// distance to its plane is (w . u - 1) / |grad|, so that an error of w enters by its square. Several vectors
/// are computed side by side.
template <int kCount>
HWY_INLINE void tangents_of(const BallLanes (&e)[kCount], const V3 (&p)[kCount], Tangent (&out)[kCount]) {
  V3 u[kCount];
  M center[kCount], any = hn::FirstN(f, 0);
#pragma GCC unroll 4
  for (int k = 0; k < kCount; ++k) {
    u[k] = in_ball(e[k], p[k]);
    const V square = dot(u[k], u[k]);
    const V3 shrink = out[k].shrink = shrink_of(e[k], u[k], square);
    out[k].w = {hn::Mul(u[k].x, shrink.x), hn::Mul(u[k].y, shrink.y), hn::Mul(u[k].z, shrink.z)};
    center[k] = hn::Lt(square, all(kLeastSquare));
    any = hn::Or(any, center[k]);
  }
  if (HWY_UNLIKELY(!hn::AllFalse(f, any)))
    for (int k = 0; k < kCount; ++k) out[k].w = select(center[k], shortest_axis(e[k]), out[k].w);
#pragma GCC unroll 4
  for (int k = 0; k < kCount; ++k) {
    const V3 w = out[k].w = scaled(out[k].w, inverse_sqrt(dot(out[k].w, out[k].w)));
    const V3 slope = add_scaled(add_scaled(scaled(e[k].a0, w.x), w.y, e[k].a1), w.z, e[k].a2);
    const V per_slope = inverse_sqrt(dot(slope, slope));
    out[k].distance = hn::Mul(hn::Sub(dot(w, u[k]), all(1.0f)), per_slope);
    out[k].normal = scaled(slope, per_slope);
  }
}

/// Corrects a tangent plane by the ellipsoid's own relief table, without blending: as corrected(), with t and
/// the quotients of the tangent.
HWY_INLINE void correct(const ReliefTables& relief, const TableLanes& table, const BallLanes& e,
                        Tangent& at) {
  constexpr float kMostShrink = 1e6f;  // limits the quotients near the center
  const V3 i = e.inverse_radius, w = absolute(at.w), signs = signs_of(at.w);
  const Correction by = correction(relief, table, {w, signs}, at.distance);
  const auto limited = [](V shrink) { return hn::Min(shrink, all(kMostShrink)); };
  const V3 shrink = {limited(at.shrink.x), limited(at.shrink.y), limited(at.shrink.z)};
  const V3 we = {hn::Mul(w.x, hn::Mul(hn::Mul(i.x, i.x), shrink.x)),
                 hn::Mul(w.y, hn::Mul(hn::Mul(i.y, i.y), shrink.y)),
                 hn::Mul(w.z, hn::Mul(hn::Mul(i.z, i.z), shrink.z))};
  const V ratio = hn::Mul(dot(by.slope, we), reciprocal(within_range(dot(w, we))));
  const V3 octant = {hn::Mul(shrink.x, hn::NegMulAdd(w.x, ratio, by.slope.x)),
                     hn::Mul(shrink.y, hn::NegMulAdd(w.y, ratio, by.slope.y)),
                     hn::Mul(shrink.z, hn::NegMulAdd(w.z, ratio, by.slope.z))};
  const V3 side = with_signs(octant, signs);
  const V3 gradient = scaled(at.normal, by.along_normal) -
                      add_scaled(add_scaled(scaled(e.a0, side.x), side.y, e.a1), side.z, e.a2);
  at.distance = hn::Sub(at.distance, by.value);
  at.normal = scaled(gradient, inverse_sqrt(within_range(dot(gradient, gradient))));
}

template <int kTables>
HWY_INLINE BallLanes balls_of(const Columns& columns, VI column) {
  const Lookup<kTables> at(column);
  return ball_lanes([&](int i) { return at(columns.row(Columns::kBall + i)); });
}

/// Vectors that are computed side by side. One needs little besides its ellipsoid, so that narrow vectors
/// read each ellipsoid for more of them.
constexpr int kVectorsAtOnce = kWidth < 16 ? 4 : 2;
static_assert(CachedBatch::kSpan % (kVectorsAtOnce * kWidth) == 0);

/// Writes the contacts of one range.
template <int kTables, bool kRelief>
HWY_INLINE void write_range(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                            const LaneRange& range, const CandidateList& candidates, const Columns& columns) {
  const V margin = all(batch.margin_m);
  const bool limited = batch.limited();
  for (int from = range.begin; from < range.end; from += kVectorsAtOnce * kWidth) {
    V3 p[kVectorsAtOnce];
    V least[kVectorsAtOnce];
    load_step(batch, from, p);
    for (V& l : least) l = all(kNoLimit_m);
    for (int i = 0; i < candidates.count; ++i) {
      const BallMap& e = baked.balls[columns.ellipsoid(candidates.index[i])];
      const VI rank = hn::Set(I(), candidates.index[i]);
      for (int v = 0; v < kVectorsAtOnce; ++v)
        least[v] = hn::Min(least[v], ranked(twice_first_order(e, p[v]), rank));
    }
    VI column[kVectorsAtOnce];
    BallLanes e[kVectorsAtOnce];
    Tangent at[kVectorsAtOnce];
#pragma GCC unroll 4
    for (int v = 0; v < kVectorsAtOnce; ++v) {
      column[v] = hn::And(hn::BitCast(I(), least[v]), hn::Set(I(), kRankMask));
      e[v] = balls_of<kTables>(columns, column[v]);
    }
    tangents_of(e, p, at);
#pragma GCC unroll 4
    for (int v = 0; v < kVectorsAtOnce; ++v)
      if constexpr (kRelief) correct(*relief, table_of<kTables>(columns, column[v]), e[v], at[v]);
    for (int v = 0; v < kVectorsAtOnce; ++v) {
      const V d = hn::Sub(at[v].distance, margin);
      const V proxy_index = Lookup<kTables>(column[v])(columns.row(Columns::kBallProxyIndex));
      ContactLanes c = {d, add_scaled(p[v], hn::Neg(d), at[v].normal), at[v].normal,
                        hn::BitCast(I(), proxy_index)};
      if (limited) hide_beyond(batch.within_m, c);
      write_contacts(c, batch, from + v * kWidth, range.end);
    }
  }
}

/// First-order query of a batch. False if a particle is too far away for floats or on overflow; contacts are
/// then unchanged or complete.
inline bool query_first_order_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  BroadPhaseLists lists;
  const QueryLimits limits(baked, relief, std::min(batch.within_m + batch.margin_m, kNoLimit_m));
  const float rounding_m = 4.0f * baked.rounding_m;
  const auto work = [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
                        const CandidateList* candidates) {
    for (int i = 0; i < count; ++i)
      if (candidates[i].count == 0)
        write_none(batch, ranges[i].begin, ranges[i].end);
      else if (relief)
        write_range<tables(), true>(baked, relief, batch, ranges[i], candidates[i], columns);
      else
        write_range<tables(), false>(baked, relief, batch, ranges[i], candidates[i], columns);
    return true;
  };
  // The cache also serves exact queries, which blend.
  const float blend_m = relief ? relief->blend_m : 0.0f;
  if (use_cache(baked, relief, blend_m + rounding_m, batch, lists))
    return with_cached_candidates(baked, relief, batch, rounding_m, limits.of_bounds(baked),
                                  Columns::Rows::kBalls, lists, work);
  if (batch.limited()) write_none(batch, 0, batch.count);  // ranges without candidates are not visited again
  return with_limited_candidates(baked, relief, batch, rounding_m, limits, lists, work);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
