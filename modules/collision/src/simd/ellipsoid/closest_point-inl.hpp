// The closest point of an ellipsoid's surface, one problem a lane.
// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
// Differs: the root is sought in u = t + r2^2, which does not cancel next to the pole; Newton on 1 / |w(u)|
// (Jorge J. More, Danny C. Sorensen. Computing a Trust Region Step. 1983), which is concave, so that every
// step but the first comes from the left of the root, lengthened as Halley's; a lane stops by its own
// residual, so that its result does not depend on its neighbors.
#if defined(BODICE_COLLISION_CLOSEST_POINT_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CLOSEST_POINT_INL_
#undef BODICE_COLLISION_CLOSEST_POINT_INL_
#else
#define BODICE_COLLISION_CLOSEST_POINT_INL_
#endif

// Products that are added are written as fused, so that the compiler has no choice: a lane's result must not
// depend on the loop in which it is computed.

#include <cstddef>

#include "model/baked.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The numbers of BakedEllipsoid, either one ellipsoid in every lane or one a lane.
struct Shape {
  V3 center, row0, row1, row2;
  V radius1, radius2, gap0, gap1, inverse1, inverse2, longest;
};

HWY_INLINE Shape broadcast(const BakedEllipsoid& e) {
  return {broadcast3(e.center),
          broadcast3(e.to_unit),
          broadcast3(e.to_unit + 3),
          broadcast3(e.to_unit + 6),
          all(e.radius1),
          all(e.radius2),
          all(e.gap0),
          all(e.gap1),
          all(e.inverse1),
          all(e.inverse2),
          all(e.longest_m)};
}

HWY_INLINE Shape select(M m, const Shape& yes, const Shape& no) {
  const auto one = [m](V a, V b) { return hn::IfThenElse(m, a, b); };
  return {select(m, yes.center, no.center), select(m, yes.row0, no.row0), select(m, yes.row1, no.row1),
          select(m, yes.row2, no.row2),     one(yes.radius1, no.radius1), one(yes.radius2, no.radius2),
          one(yes.gap0, no.gap0),           one(yes.gap1, no.gap1),       one(yes.inverse1, no.inverse1),
          one(yes.inverse2, no.inverse2),   one(yes.longest, no.longest)};
}

HWY_INLINE V field(const CullArrays& cull, std::size_t which, std::size_t k) {
  return hn::LoadU(f, cull.baked[which].data() + k);
}
HWY_INLINE V3 field3(const CullArrays& cull, std::size_t which, std::size_t k) {
  return {field(cull, which, k), field(cull, which + 1, k), field(cull, which + 2, k)};
}

/// Ellipsoid k + lane in each lane.
HWY_INLINE Shape consecutive(const CullArrays& c, std::size_t k) {
  return {field3(c, 0, k), field3(c, 3, k), field3(c, 6, k), field3(c, 9, k),
          field(c, 12, k), field(c, 13, k), field(c, 14, k), field(c, 15, k),
          field(c, 16, k), field(c, 17, k), field(c, 18, k)};
}

struct ClosestPointLanes {
  V distance;  ///< meters, negative inside
  V3 n;        ///< outward normal, as long as the longest radius, in the octant and axes of w
  V3 w;        ///< direction of the closest on the unit sphere, first octant, axes by
               ///< falling radius
  V3 y;        ///< the point in the ellipsoid's frame, in units of its longest radius,
               ///< signed
  V u;         ///< the root
};

constexpr int kUsualSteps = 2;         // the one from the surface included: enough near limb-like shapes
constexpr int kMaxSteps = 24;          // what 1:1000 can need
constexpr int kHalleySteps = 4;        // then Newton, which cannot overshoot twice
constexpr float kConverged = 1e-3f;    // of |w|^2 - 1, before the last correction, which squares it
constexpr float kShortStep = 2e-2f;    // twice the share of u that the last correction may be
constexpr float kRounding = 1e-6f;     // of |w|^2
constexpr float kLeastHalley = 0.25f;  // the curvature may lengthen a step fourfold
// u = t + r2^2 in units of r0^2, relative to the smallest of which (1:1000) this is still a millionth.
constexpr float kLeastRoot = 1e-12f;

/// w_j = a_j / (u + gap_j), and the sums of w_j^2 / (u + gap_j)^n that its derivatives need, n = 0, 1, 2.
struct Secular {
  V3 w, slope;  // slope_j = w_j / (u + gap_j)
  V norm2, first, second;
};

HWY_INLINE Secular secular(V3 w, V3 inverse) {
  const V3 slope = {hn::Mul(w.x, inverse.x), hn::Mul(w.y, inverse.y), hn::Mul(w.z, inverse.z)};
  return {w, slope, dot(w, w), dot(w, slope), dot(slope, slope)};
}

/// By estimates, too, where another step follows.
template <bool kLast = true>
HWY_INLINE Secular evaluate(V3 a, V gap0, V gap1, V u) {
  const auto inverted = [](V e) { return kLast ? reciprocal(e) : estimated_reciprocal(e); };
  const V3 inverse = {inverted(hn::Add(u, gap0)), inverted(hn::Add(u, gap1)), inverted(u)};
  return secular({hn::Mul(a.x, inverse.x), hn::Mul(a.y, inverse.y), hn::Mul(a.z, inverse.z)}, inverse);
}

constexpr float kLeastNorm2 = 1e-35f;  // w = 0 at the center: a step is then of no use, but must be finite

/// Newton's step on 1 / |w|: (|w| - 1) |w|^2 / sum w^2 / e; Halley divides it by 1 + half its curvature. By
/// estimates: what a step is off by is left to the next.
template <bool kHalley>
HWY_INLINE V next_root(const Secular& g, V u, V low) {
  const V one = all(1.0f), least = all(kLeastNorm2);
  const V norm2 = hn::Max(g.norm2, least);
  const V inverse = estimated_reciprocal(hn::Max(g.first, least));
  const V inverse_norm = estimated_inverse_sqrt(norm2);
  // |w| - 1 without what the estimate is off by: next to the focal ellipse of thin shapes all hangs on it.
  const V norm_and_one = hn::MulAdd(norm2, inverse_norm, one);
  const V excess = hn::Mul(hn::Sub(norm2, one), estimated_reciprocal(norm_and_one));
  const V scale = hn::Mul(norm2, inverse);
  V longer = one;
  if constexpr (kHalley) {
    // 1 - 3/2 step (S_0 S_2 - S_1^2) / (S_0 S_1)
    const V bend = hn::NegMulAdd(g.first, hn::Mul(inverse_norm, inverse_norm), hn::Mul(g.second, inverse));
    const V half = hn::Mul(hn::Mul(all(1.5f), excess), scale);
    longer = estimated_reciprocal(hn::Max(hn::NegMulAdd(half, bend, one), all(kLeastHalley)));
  }
  const V next = hn::MulAdd(hn::Mul(excess, scale), longer, u);
  return hn::IfThenElse(hn::Gt(next, low), next,
                        low);  // low where the step is NaN: sums have overflowed
}

/// Halley's step with all denominators in one: (|w|^2 - 1) N S_1 / (q S_1^2 - 3/2 (|w|^2 - 1) (N S_2 -
/// S_1^2)), q = |w| + 1. Products of sums overflow earlier than those of next_root(), which then takes over.
HWY_INLINE V usual_root(const Secular& g, V u, V low) {
  const V one = all(1.0f);
  const V excess = hn::Sub(g.norm2, one);
  const V norm_and_one = hn::MulAdd(g.norm2, estimated_inverse_sqrt(g.norm2), one);
  const V first2 = hn::Mul(g.first, g.first);
  const V bend = hn::MulSub(g.norm2, g.second, first2);
  const V newton = hn::Mul(norm_and_one, first2);
  const V halley = hn::NegMulAdd(hn::Mul(all(1.5f), excess), bend, newton);
  const V below = hn::Max(halley, hn::Mul(all(kLeastHalley), newton));
  const V above = hn::Mul(hn::Mul(g.norm2, g.first), excess);
  const V next = hn::MulAdd(above, estimated_reciprocal(below), u);
  return hn::IfThenElse(hn::Gt(next, low), next, low);
}

/// Lanes that need another step; a lane judges by itself, so that its result does not depend on its
/// neighbors.
HWY_INLINE M needs_step(const Secular& g, V u, V low) {
  // Next to the focal ellipse of a thin shape all of w_z, and with it the normal, hangs on the last digits of
  // u that |w| hardly feels: there the step that is left must be short beside u, as far as |w| can tell.
  const V share = hn::Max(hn::Mul(all(kShortStep), hn::Mul(u, g.first)), all(kRounding));
  const M off = hn::Gt(hn::Abs(hn::Sub(g.norm2, all(1.0f))), hn::Min(share, all(kConverged)));
  return hn::And(off, hn::Or(hn::Gt(u, low), hn::Gt(g.norm2, all(1.0f))));
}

template <bool kHalley>
HWY_INLINE void step_where(M active, V3 a, const Shape& s, V low, V& u, Secular& g) {
  u = hn::IfThenElse(active, next_root<kHalley>(g, u, low), u);
  g = evaluate(a, s.gap0, s.gap1, u);
}

/// One problem on its way: |y| and a = r o |y|, all components >= 0, the iterate and its lower end.
struct Search {
  V3 y, a;
  V low, u;
  Secular at;
};

HWY_INLINE Search start_from_surface(V3 y, const Shape& s) {
  Search result;
  result.y = absolute(y);
  const V3 a = result.a = {result.y.x, hn::Mul(s.radius1, result.y.y), hn::Mul(s.radius2, result.y.z)};
  // |w| >= 1 at each of these, so none lies right of the root (except the floor, on the medial disk).
  const V a2 = hn::Max(dot(a, a), all(kLeastNorm2));
  const V norm = hn::Mul(hn::Mul(a2, all(1.0f - kEstimate)), estimated_inverse_sqrt(a2));
  const V start = hn::Max(hn::Max(a.z, hn::Sub(a.y, s.gap1)), hn::Sub(hn::Max(norm, a.x), s.gap0));
  result.low = hn::Max(start, all(kLeastRoot));
  // Particles are near the surface, where u = r2^2 and w = y / r.
  const V3 inverse_r2 = {all(1.0f), hn::Mul(s.inverse1, s.inverse1), hn::Mul(s.inverse2, s.inverse2)};
  result.at =
      secular({result.y.x, hn::Mul(result.y.y, s.inverse1), hn::Mul(result.y.z, s.inverse2)}, inverse_r2);
  result.u = hn::Mul(s.radius2, s.radius2);
  return result;
}

/// The steps that few points need.
HWY_INLINE void refine(M active, const Shape& s, Search& search) {
  for (int step = kUsualSteps; step < kMaxSteps && !hn::AllFalse(f, active); ++step) {
    if (step < kHalleySteps)
      step_where<true>(active, search.a, s, search.low, search.u, search.at);
    else
      step_where<false>(active, search.a, s, search.low, search.u, search.at);
    active = hn::And(active, needs_step(search.at, search.u, search.low));
  }
}

/// The closest direction, first octant, its length 1 to first order; the root is brought up to date.
HWY_INLINE V3 last_direction(Search& search) {
  const V one = all(1.0f);
  const Secular& g = search.at;
  // On the medial disk |w| < 1 even at the pole: the shortest axis takes the rest.
  const M medial = hn::And(hn::Le(search.u, all(kLeastRoot)), hn::Lt(g.norm2, one));
  // The last step, to first order: |w|^2 falls by twice the first sum.
  const V excess = hn::Mul(all(0.5f), hn::Sub(g.norm2, one));
  const V last =
      hn::IfThenZeroElse(medial, hn::Mul(excess, estimated_reciprocal(hn::Max(g.first, all(kLeastNorm2)))));
  V3 w = add_scaled(g.w, hn::Neg(last), g.slope);
  search.u = hn::Add(search.u, last);
  if (hn::AllFalse(f, medial)) return w;
  const V across = hn::MulAdd(w.x, w.x, hn::Mul(w.y, w.y));
  const V rest = hn::Sqrt(hn::Max(hn::Zero(f), hn::Sub(one, across)));
  w.z = hn::IfThenElse(medial, hn::Max(rest, w.z), w.z);
  return w;
}

/// From the direction to the distance and the normal; `y` is signed.
HWY_INLINE void finish_point(const Shape& s, V3 y, Search& search, ClosestPointLanes& result) {
  result.y = y;
  const V3 raw = last_direction(search);
  result.u = search.u;
  const V3 g = {raw.x, hn::Mul(raw.y, s.inverse1), hn::Mul(raw.z, s.inverse2)};
  // Of w and of w / r side by side: the normal does not care how long w is. The last step has left of |w|^2 -
  // 1 about kConverged squared, of which the expansion of 1 / |w| about 1 drops the square.
  const V inverse_norm = hn::NegMulAdd(all(0.5f), dot(raw, raw), all(1.5f));
  const V3 w = result.w = scaled(raw, inverse_norm);
  const V3 n = result.n = scaled(g, hn::Mul(s.longest, inverse_sqrt(dot(g, g))));
  const V3 off = {hn::NegMulAdd(raw.x, inverse_norm, search.y.x), hn::NegMulAdd(s.radius1, w.y, search.y.y),
                  hn::NegMulAdd(s.radius2, w.z, search.y.z)};
  result.distance = dot(n, off);
}

/// From the ellipsoid's frame, axes by falling radius, to the local frame of the collider; shorter by the
/// longest radius.
HWY_INLINE V3 out_of(const Shape& s, V3 v) {
  return {hn::MulAdd(s.row0.x, v.x, hn::MulAdd(s.row1.x, v.y, hn::Mul(s.row2.x, v.z))),
          hn::MulAdd(s.row0.y, v.x, hn::MulAdd(s.row1.y, v.y, hn::Mul(s.row2.y, v.z))),
          hn::MulAdd(s.row0.z, v.x, hn::MulAdd(s.row1.z, v.y, hn::Mul(s.row2.z, v.z)))};
}

/// Outward, unit, local frame of the collider.
HWY_INLINE V3 normal_of(const Shape& s, const ClosestPointLanes& closest) {
  return out_of(s, with_signs(closest.n, signs_of(closest.y)));
}

template <bool kLast>
HWY_INLINE void usual_step(const Shape& s, Search& search) {
  search.u = usual_root(search.at, search.u, search.low);
  search.at = evaluate<kLast>(search.a, s.gap0, s.gap1, search.u);
}

/// Vectors of problems that are worked on in step.
constexpr int kVectorsInStep = 2;

/// Some vectors of problems, of which some lanes need more steps.
template <int kCount>
struct Unconverged {
  Shape shape[kCount];
  Search search[kCount];
  M active[kCount];
};

/// Not in line: what it works on must lie in memory, while that of all others can stay in registers.
template <int kCount>
HWY_NOINLINE void refine_each(Unconverged<kCount>& some) {
  for (int i = 0; i < kCount; ++i)
    if (!hn::AllFalse(f, some.active[i])) refine(some.active[i], some.shape[i], some.search[i]);
}

/// Several vectors of problems in step, since each waits for its own results most of the time.
template <int kCount>
HWY_INLINE void closest_points(const Shape (&s)[kCount], const V3 (&p)[kCount],
                               ClosestPointLanes (&out)[kCount]) {
  V3 y[kCount];
  Search search[kCount];
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    const V3 q = p[i] - s[i].center;
    y[i] = {dot(s[i].row0, q), dot(s[i].row1, q), dot(s[i].row2, q)};
    search[i] = start_from_surface(y[i], s[i]);
  }
  static_assert(kUsualSteps == 2);
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) usual_step<false>(s[i], search[i]);
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) usual_step<true>(s[i], search[i]);
  M active[kCount], any = hn::FirstN(f, 0);
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) {
    active[i] = needs_step(search[i].at, search[i].u, search[i].low);
    any = hn::Or(any, active[i]);
  }
  if (!hn::AllFalse(f, any)) {
    Unconverged<kCount> some;
#pragma GCC unroll 4
    for (int i = 0; i < kCount; ++i) {
      some.shape[i] = s[i];
      some.search[i] = search[i];
      some.active[i] = active[i];
    }
    refine_each(some);
#pragma GCC unroll 4
    for (int i = 0; i < kCount; ++i) search[i] = some.search[i];
  }
#pragma GCC unroll 4
  for (int i = 0; i < kCount; ++i) finish_point(s[i], y[i], search[i], out[i]);
}

HWY_INLINE ClosestPointLanes closest_point(const Shape& s, V3 p) {
  const Shape shapes[1] = {s};
  const V3 points[1] = {p};
  ClosestPointLanes closest[1];
  closest_points(shapes, points, closest);
  return closest[0];
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
