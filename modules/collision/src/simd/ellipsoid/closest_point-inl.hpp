// The closest point of an ellipsoid's surface, one problem a lane. modules/geometry/README.md has the
// derivation; [1] to [4] are its equations (3) to (6). In
// the ellipsoid's frame, with r0 as the unit of length, y is the particle and r = (1, r1, r2) are the radii.
// The closest point is r o w, w a unit vector, and the normal there is parallel to w / r. Hence y = r o w + t
// w / r, and with a = r o |y|, u = t + r2^2, gap_j = r_j^2 - r2^2:
//   [1] w_j(u) = a_j / (u + gap_j)
//   [2] |w(u)| = 1 at the root u > 0
//   [3] distance = n . (|y| - r o w), n = (w / r) / |w / r|
// With S_n = sum_j w_j^2 / (u + gap_j)^n, Newton's step on 1 / |w| - 1 and the factor by which Halley's
// method lengthens it are
//   [4] du = (|w| - 1) S_0 / S_1
//   [5] 1 / (1 - 3/2 (|w| - 1) (S_0 S_2 - S_1^2) / S_1^2)
// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013; Jorge
// J. More, Danny C. Sorensen. Computing a Trust Region Step. 1983, for [4].
// Differs: u, unlike t, does not cancel next to the pole. 1 / |w| is concave, so that every step but the
// first starts left of the root. A lane stops by its own residual, so that its result does not depend on
// other lanes.
#if defined(BODICE_COLLISION_CLOSEST_POINT_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CLOSEST_POINT_INL_
#undef BODICE_COLLISION_CLOSEST_POINT_INL_
#else
#define BODICE_COLLISION_CLOSEST_POINT_INL_
#endif

// Sums of products are written as fused operations, so that the compiler has no choice: a lane's result must
// not depend on the loop in which it is computed.

#include "simd/ellipsoid/shape-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr int kUsualSteps = 2;         // includes the one from the surface; enough near shapes like limbs
constexpr int kMaxSteps = 24;          // the most that aspect ratios of 1:1000 need
constexpr int kHalleySteps = 4;        // then Newton, which cannot overshoot twice
constexpr float kConverged = 1e-3f;    // residual of |w|^2 before the last correction, which squares it
constexpr float kShortStep = 2e-2f;    // twice the relative change of u that the last correction may make
constexpr float kRounding = 1e-6f;     // relative, of |w|^2
constexpr float kLeastHalley = 0.25f;  // the curvature may lengthen a step fourfold
// Least u in units of r0^2; it is still a millionth of the smallest r2^2, that of an aspect ratio of 1:1000.
constexpr float kLeastRoot = 1e-12f;

/// w of [1] at one u, and the sums S_0, S_1 and S_2.
struct Secular {
  V3 w, slope;  // slope_j = w_j / (u + gap_j)
  V norm2, first, second;
};

HWY_INLINE Secular secular(V3 w, V3 inverse) {
  const V3 slope = {hn::Mul(w.x, inverse.x), hn::Mul(w.y, inverse.y), hn::Mul(w.z, inverse.z)};
  return {w, slope, dot(w, w), dot(w, slope), dot(slope, slope)};
}

/// Computes w and its sums at u; by estimates unless this is the last step.
template <bool kLast = true>
HWY_INLINE Secular evaluate(V3 a, V gap0, V gap1, V u) {
  const auto inverted = [](V e) { return kLast ? reciprocal(e) : estimated_reciprocal(e); };
  const V3 inverse = {inverted(hn::Add(u, gap0)), inverted(hn::Add(u, gap1)), inverted(u)};
  return secular({hn::Mul(a.x, inverse.x), hn::Mul(a.y, inverse.y), hn::Mul(a.z, inverse.z)}, inverse);
}

constexpr float kLeastNorm2 = 1e-35f;  // w = 0 at the center: the step is useless there but must be finite

/// The next u by [4], or by [4] and [5]. It uses estimates, since the next step corrects their error.
template <bool kHalley>
HWY_INLINE V next_root(const Secular& g, V u, V low) {
  const V one = all(1.0f), least = all(kLeastNorm2);
  const V norm2 = hn::Max(g.norm2, least);
  const V inverse = estimated_reciprocal(hn::Max(g.first, least));
  const V inverse_norm = estimated_inverse_sqrt(norm2);
  // The error of the estimate is kept out of |w| - 1, because next to the focal ellipse of thin shapes the
  // result depends on its last digits.
  const V norm_and_one = hn::MulAdd(norm2, inverse_norm, one);
  const V excess = hn::Mul(hn::Sub(norm2, one), estimated_reciprocal(norm_and_one));
  const V scale = hn::Mul(norm2, inverse);
  V longer = one;
  if constexpr (kHalley) {
    // The denominator of [5].
    const V bend = hn::NegMulAdd(g.first, hn::Mul(inverse_norm, inverse_norm), hn::Mul(g.second, inverse));
    const V half = hn::Mul(hn::Mul(all(1.5f), excess), scale);
    longer = estimated_reciprocal(hn::Max(hn::NegMulAdd(half, bend, one), all(kLeastHalley)));
  }
  const V next = hn::MulAdd(hn::Mul(excess, scale), longer, u);
  return hn::IfThenElse(hn::Gt(next, low), next,
                        low);  // also where overflowing sums make the step NaN
}

/// The next u by [4] and [5] over one denominator: (S_0 - 1) S_0 S_1 / (q S_1^2 - 3/2 (S_0 - 1) (S_0 S_2 -
/// S_1^2)), q = |w| + 1. Its products overflow earlier than those of next_root(), which then takes over.
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

/// Lanes that need another step. The condition of a lane uses the values of that lane only, so that its
/// result does not depend on other lanes.
HWY_INLINE M needs_step(const Secular& g, V u, V low) {
  // Next to the focal ellipse of a thin shape w_z, and with it the normal, depends on the last digits of u,
  // to which |w| is hardly sensitive. There the remaining step must be short beside u, as far as |w|
  // determines it.
  const V share = hn::Max(hn::Mul(all(kShortStep), hn::Mul(u, g.first)), all(kRounding));
  const M off = hn::Gt(hn::Abs(hn::Sub(g.norm2, all(1.0f))), hn::Min(share, all(kConverged)));
  return hn::And(off, hn::Or(hn::Gt(u, low), hn::Gt(g.norm2, all(1.0f))));
}

template <bool kHalley>
HWY_INLINE void step_where(M active, V3 a, const Shape& s, V low, V& u, Secular& g) {
  u = hn::IfThenElse(active, next_root<kHalley>(g, u, low), u);
  g = evaluate(a, s.gap0, s.gap1, u);
}

/// The state of one problem: |y| and a = r o |y|, all components >= 0, the current u, its lower bound, and
/// the sums at u.
struct Search {
  V3 y, a;
  V low, u;
  Secular at;
};

HWY_INLINE Search start_from_surface(V3 y, const Shape& s) {
  Search result;
  result.y = absolute(y);
  const V3 a = result.a = {result.y.x, hn::Mul(s.radius1, result.y.y), hn::Mul(s.radius2, result.y.z)};
  // |w| >= 1 at each of these values of u, so none lies right of the root (except the floor, on the medial
  // disk).
  const V a2 = hn::Max(dot(a, a), all(kLeastNorm2));
  const V norm = hn::Mul(hn::Mul(a2, all(1.0f - kEstimate)), estimated_inverse_sqrt(a2));
  const V start = hn::Max(hn::Max(a.z, hn::Sub(a.y, s.gap1)), hn::Sub(hn::Max(norm, a.x), s.gap0));
  result.low = hn::Max(start, all(kLeastRoot));
  // Most particles are near the surface, where u = r2^2 and w = y / r.
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

/// The last correction of u, to first order, and w in the first octant with unit length to first order.
HWY_INLINE V3 last_direction(Search& search) {
  const V one = all(1.0f);
  const Secular& g = search.at;
  // On the medial disk |w| < 1 even at the pole; the component along the shortest axis takes the rest.
  const M medial = hn::And(hn::Le(search.u, all(kLeastRoot)), hn::Lt(g.norm2, one));
  // To first order |w|^2 falls by 2 S_1 times the step.
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

/// Computes distance and normal from w; `y` is signed.
HWY_INLINE void finish_point(const Shape& s, V3 y, Search& search, ClosestPointLanes& result) {
  result.y = y;
  const V3 raw = last_direction(search);
  result.u = search.u;
  const V3 g = {raw.x, hn::Mul(raw.y, s.inverse1), hn::Mul(raw.z, s.inverse2)};
  // w and w / r are scaled side by side, because the normal does not depend on the length of w. After the
  // last step |w|^2 - 1 is about kConverged squared; the expansion of 1 / |w| about 1 drops its square.
  const V inverse_norm = hn::NegMulAdd(all(0.5f), dot(raw, raw), all(1.5f));
  const V3 w = result.w = scaled(raw, inverse_norm);
  const V3 n = result.n = scaled(g, hn::Mul(s.longest, inverse_sqrt(dot(g, g))));
  const V3 off = {hn::NegMulAdd(raw.x, inverse_norm, search.y.x), hn::NegMulAdd(s.radius1, w.y, search.y.y),
                  hn::NegMulAdd(s.radius2, w.z, search.y.z)};
  result.distance = dot(n, off);
}

template <bool kLast>
HWY_INLINE void usual_step(const Shape& s, Search& search) {
  search.u = usual_root(search.at, search.u, search.low);
  search.at = evaluate<kLast>(search.a, s.gap0, s.gap1, search.u);
}

/// Several vectors of problems, some lanes of which need more steps.
template <int kCount>
struct Unconverged {
  Shape shape[kCount];
  Search search[kCount];
  M active[kCount];
};

/// This function is not inlined, because its operands must lie in memory, while the common case keeps them in
/// registers.
template <int kCount>
HWY_NOINLINE void refine_each(Unconverged<kCount>& some) {
  for (int i = 0; i < kCount; ++i)
    if (!hn::AllFalse(f, some.active[i])) refine(some.active[i], some.shape[i], some.search[i]);
}

/// The closest points of several vectors of particles, side by side.
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
