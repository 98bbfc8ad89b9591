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

#include <algorithm>

#include "simd/broad/cache-inl.hpp"
#include "simd/broad/domination-inl.hpp"
#include "simd/ellipsoid/relief_table-inl.hpp"
#include "simd/narrow/buried-inl.hpp"
#include "simd/narrow/query-inl.hpp"
#include "simd/narrow/unions-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

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
  V distance;      ///< signed distance to the plane, meters: a lower bound of that to the ellipsoid
  V3 normal;       ///< outward, unit, local frame
  V3 w;            ///< point of contact as a direction on the unit sphere, axes of the proxy
  V3 shrink;       ///< r_j^2 / (t + r_j^2), with t after one step
  V plain, score;  ///< poses only: the distance without the table, and with the burial, meters
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
/// the quotients of the tangent. Returns the burial there, where it counts.
template <bool kBuries>
HWY_INLINE V correct(const ReliefTables& relief, const TableLanes& table, const BallLanes& e, Tangent& at) {
  constexpr float kMostShrink = 1e6f;  // limits the quotients near the center
  const V3 i = e.inverse_radius, w = absolute(at.w), signs = signs_of(at.w);
  const Correction by = correction<kBuries>(relief, table, {w, signs}, at.distance);
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
  return by.burial;
}

/// Vectors that are computed side by side. One needs little besides its ellipsoid, so that narrow vectors
/// read each ellipsoid for more of them.
constexpr int kVectorsAtOnce = kWidth < 16 ? 4 : 2;
static_assert(CachedBatch::kSpan % (kVectorsAtOnce * kWidth) == 0);

/// Writes first-order contacts of ranges of lanes with their candidates. In a pose, where the nearest
/// ellipsoid is buried, those of the owner, or it notes the lane.
template <class Union>
struct FirstOrderEvaluation {
  const Union& proxy;
  const Batch& batch;
  const ContactOutput& out;
  float plain_m;  ///< distance up to which all ellipsoids are candidates, meters
  BuriedParticles& buried;

  Status operator()(const Candidates& among) const {
    return with_tables(among.columns, [&](auto tables) { return write<tables()>(among); });
  }

 private:
  /// Candidates that are kept of each particle besides the nearest.
  static constexpr int kFollowing = Union::kBuries ? BuriedParticles::kFollowing + 1 : 0;
  using Lowest = LowestBounds<kFollowing>;
  using ColumnsOf = VI[kVectorsAtOnce];

  template <int kTables>
  HWY_INLINE Status write(const Candidates& among) const {
    if constexpr (Union::kBuries) buried.clear();
    for (int i = 0; i < among.count; ++i)
      if (among.lists[i].count == 0)
        write_none(out, among.ranges[i].begin, among.ranges[i].end);
      else
        write_range<kTables>(among.ranges[i], among.lists[i], among.columns);
    if constexpr (Union::kBuries) write_buried<kTables>(among.columns);
    return Status::kDone;
  }
  /// The ellipsoids of least first-order distance: twice that, and their columns.
  HWY_INLINE void find_nearest(const CandidateList& candidates, const Columns& columns,
                               const V3 (&p)[kVectorsAtOnce], Lowest (&lowest)[kVectorsAtOnce]) const {
    for (Lowest& l : lowest) l.clear();
    for (int i = 0; i < candidates.count; ++i) {
      const BallMap& e = proxy.model.baked.balls[columns.ellipsoid(candidates.index[i])];
      const VI rank = hn::Set(I(), candidates.index[i]);
      for (int v = 0; v < kVectorsAtOnce; ++v) lowest[v].add(twice_first_order(e, p[v]), rank);
    }
  }
  /// The tangent planes of the ellipsoids in some columns, corrected by their tables if there are any.
  template <int kTables>
  HWY_INLINE void find_tangents(const Columns& columns, const ColumnsOf& column,
                                const V3 (&p)[kVectorsAtOnce], Tangent (&at)[kVectorsAtOnce]) const {
    BallLanes e[kVectorsAtOnce];
#pragma GCC unroll 4
    for (int v = 0; v < kVectorsAtOnce; ++v)
      e[v] = ball_lanes(ColumnLanes<kTables>(columns, column[v], Columns::kBall));
    tangents_of(e, p, at);
#pragma GCC unroll 4
    for (int v = 0; v < kVectorsAtOnce; ++v)
      if constexpr (Union::kBlends) {
        const ColumnLanes<kTables> of_table(columns, column[v], Columns::kTable);
        if constexpr (Union::kBuries) at[v].plain = at[v].distance;
        const V burial = correct<Union::kBuries>(proxy.relief(), table_from(of_table), e[v], at[v]);
        if constexpr (Union::kBuries) at[v].score = hn::Add(at[v].plain, burial);
      }
  }
  /// The contact of a tangent plane.
  template <int kTables>
  HWY_INLINE ContactLanes contact_of(const Columns& columns, VI column, V3 p, const Tangent& at) const {
    const V d = hn::Sub(at.distance, all(out.margin_m));
    const ColumnLanes<kTables> of_owner(columns, column);
    ContactLanes c = {d, add_scaled(p, hn::Neg(d), at.normal), at.normal,
                      of_owner.integer(Columns::kBallProxyIndex)};
    if (out.limited()) hide_beyond(out.within_m, c);
    return c;
  }
  template <int kTables>
  HWY_INLINE void write_range(const LaneRange& range, const CandidateList& candidates,
                              const Columns& columns) const {
    for (int from = range.begin; from < range.end; from += kVectorsAtOnce * kWidth) {
      V3 p[kVectorsAtOnce];
      Lowest lowest[kVectorsAtOnce];
      ColumnsOf column;
      Tangent at[kVectorsAtOnce];
      load_step(batch, from, p);
      find_nearest(candidates, columns, p, lowest);
      for (int v = 0; v < kVectorsAtOnce; ++v) column[v] = lowest[v].rank(0);
      find_tangents<kTables>(columns, column, p, at);
      for (int v = 0; v < kVectorsAtOnce; ++v) {
        const int i = from + v * kWidth;
        write_contacts(contact_of<kTables>(columns, column[v], p[v], at[v]), out, i, range.end);
        if constexpr (Union::kBuries)
          buried.add(lanes_below(i, range.end), i, nearest_of(lowest[v], at[v]), all(proxy.model.blend_m()));
      }
    }
  }
  HWY_INLINE NearestToFirstOrder nearest_of(const Lowest& lowest, const Tangent& at) const {
    const auto half = [](V twice) { return hn::Mul(all(0.5f), twice); };
    const V known = hn::Add(hn::Min(at.plain, all(plain_m)), all(proxy.model.certain_m()));
    return {at.plain,       at.score,
            known,          {half(lowest.bound[1]), half(lowest.bound[2]), half(lowest.bound[3])},
            lowest.rank(1), lowest.rank(2)};
  }
  /// Contacts of the buried particles: of the candidates that follow the nearest, that of the least score.
  template <int kTables>
  HWY_INLINE void write_buried(const Columns& columns) const {
    constexpr int kStepOfPairs = kVectorsAtOnce * kWidth;
    if (buried.pairs > 0) buried.pad(kStepOfPairs);
    for (int from = 0; from < buried.pairs; from += kStepOfPairs) {
      V3 p[kVectorsAtOnce];
      ColumnsOf column;
      Tangent at[kVectorsAtOnce];
      for (int v = 0; v < kVectorsAtOnce; ++v) {
        const int i = from + v * kWidth;
        column[v] = hn::LoadU(I(), buried.pair_column + i);
        p[v] = gather3(batch.at.x, batch.at.y, batch.at.z, hn::LoadU(I(), buried.pair_lane + i));
      }
      find_tangents<kTables>(columns, column, p, at);
      for (int v = 0; v < kVectorsAtOnce; ++v) {
        const int i = from + v * kWidth;
        hn::StoreU(at[v].score, f, buried.pair_score_m + i);
        hn::StoreU(hn::Sub(at[v].score, at[v].plain), f, buried.pair_burial_m + i);
        store_contacts(contact_of<kTables>(columns, column[v], p[v], at[v]),
                       [&](int k) { return buried.contact(i + k); });
      }
    }
    if (buried.count > 0) buried.write_least(out, proxy.model.blend_m());
  }
};

/// First-order query of a batch among its candidates by distance.
template <class Union>
Status query_nearest_to_first_order(const Union& proxy, Batch& batch, const ContactOutput& out,
                                    BuriedParticles& buried) {
  const ProxyModel& model = proxy.model;
  BroadPhase broad(model);
  const QueryLimits limits(model, std::min(out.within_m + out.margin_m, kNoLimit_m));
  const float rounding_m = 4.0f * model.baked.rounding_m, beyond_m = rounding_m + model.certain_m();
  const FirstOrderEvaluation<Union> evaluate{proxy, batch, out, limits.plain_m, buried};
  // The cache also serves exact queries, which blend.
  if (refresh_if_stale<NotDominated<false>>(model.beyond_m() + rounding_m, batch, broad))
    return broad.take_cached(batch, beyond_m, limits.of_bounds(model.baked), Columns::Rows::kBalls, evaluate);
  // Ranges without candidates are not visited again.
  if (out.limited()) write_none(out, 0, batch.at.count);
  const Blocks blocks(batch.at, {0, batch.at.count});
  if (!blocks.in_float_range) return Status::kTooFar;
  blocks.note_radii(batch.radius_m);
  const NotBeyondNorDominated rule(limits.plain_m, beyond_m, blocks.ranges[0].box);
  return broad.search(blocks.ranges, blocks.count, rule, evaluate);
}

/// First-order query of a batch; unless it is done, contacts are unchanged or complete.
template <class Union>
HWY_INLINE Status query_first_order(const Union& proxy, Batch& batch, const ContactOutput& out) {
  BuriedParticles buried;
  const Status status = query_nearest_to_first_order(proxy, batch, out, buried);
  if constexpr (Union::kBuries)
    if (status == Status::kDone) return query_lanes(proxy, batch, buried.to_exact, out);
  return status;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
