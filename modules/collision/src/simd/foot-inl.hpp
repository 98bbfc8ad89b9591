// The nearest point of an ellipsoid's surface, one problem a lane.
// Based on: David Eberly. Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid. 2013.
// Differs: the root is sought in u = t + r2^2, which does not cancel next to the pole; Newton on 1 / |w(u)|
// (Jorge J. More, Danny C. Sorensen. Computing a Trust Region Step. 1983), which is concave, so that every
// step but the first comes from the left of the root; a lane stops by its own residual, so that its result
// does not depend on its neighbours.
#if defined(BODICE_COLLISION_FOOT_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_FOOT_INL_
#undef BODICE_COLLISION_FOOT_INL_
#else
#define BODICE_COLLISION_FOOT_INL_
#endif

#include <cstddef>

#include "baked.hpp"
#include "simd/vec3-inl.hpp"

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

using I = hn::RebindToSigned<F>;
using VI = hn::Vec<I>;

HWY_INLINE V field(const BakedEllipsoid* table, VI first_float, std::size_t offset) {
  return hn::GatherIndex(f, reinterpret_cast<const float*>(table) + offset, first_float);
}
HWY_INLINE V3 field3(const BakedEllipsoid* table, VI first_float, std::size_t offset) {
  return {field(table, first_float, offset), field(table, first_float, offset + 1),
          field(table, first_float, offset + 2)};
}

/// Ellipsoid table[index[lane]] in each lane.
HWY_INLINE Shape gather(const BakedEllipsoid* table, VI index) {
  const VI at = hn::Mul(index, hn::Set(I(), kBakedFloats));
  return {field3(table, at, 0), field3(table, at, 3), field3(table, at, 6), field3(table, at, 9),
          field(table, at, 12), field(table, at, 13), field(table, at, 14), field(table, at, 15),
          field(table, at, 16), field(table, at, 17), field(table, at, 18)};
}

struct Foot {
  V distance;  ///< metres, negative inside
  V3 normal;   ///< outward, unit, local frame of the collider
  V3 w;        ///< direction of the foot on the unit sphere, first octant, axes by falling radius
  V3 y;        ///< the point in the ellipsoid's frame, in units of its longest radius, signed
  V u;         ///< the root
};

constexpr int kMaxNewton = 24;  // 2 to 4 near a limb-like ellipsoid; 1:1000 needs up to 20

/// w_j = a_j / (u + gap_j), and the sums that Newton needs.
struct Secular {
  V3 w;
  V norm2, slope;
};

HWY_INLINE Secular evaluate(V3 a, V gap0, V gap1, V u) {
  const V one = all(1.0f);
  const V i0 = hn::Div(one, hn::Add(u, gap0));
  const V i1 = hn::Div(one, hn::Add(u, gap1));
  const V i2 = hn::Div(one, u);
  const V3 w = {hn::Mul(a.x, i0), hn::Mul(a.y, i1), hn::Mul(a.z, i2)};
  const V3 w2 = {hn::Mul(w.x, w.x), hn::Mul(w.y, w.y), hn::Mul(w.z, w.z)};
  return {w, hn::Add(w2.x, hn::Add(w2.y, w2.z)), dot(w2, {i0, i1, i2})};
}

/// The unit foot direction for a = r o |y|, all components >= 0; `u` receives the root.
HWY_INLINE V3 foot_direction(V3 a, const Shape& s, V& u) {
  const V zero = hn::Zero(f), one = all(1.0f);
  const V floor = all(1e-30f);
  // |w| >= 1 at each of these, so none lies right of the root (except the floor, on the medial disk).
  const V start = hn::Max(hn::Max(a.z, hn::Sub(a.x, s.gap0)),
                          hn::Max(hn::Sub(a.y, s.gap1), hn::Sub(hn::Sqrt(dot(a, a)), s.gap0)));
  const V low = hn::Max(start, floor);
  // Particles are near the surface, where u = r2^2.
  u = hn::Max(low, hn::Mul(s.radius2, s.radius2));
  Secular g = evaluate(a, s.gap0, s.gap1, u);
  M active = hn::Gt(g.norm2, zero);
  for (int step = 0; step < kMaxNewton; ++step) {
    const V norm = hn::Sqrt(g.norm2);
    const V residual = hn::Sub(norm, one);
    const V slope = hn::IfThenElse(active, g.slope, one);
    const V next = hn::Max(low, hn::Add(u, hn::Div(hn::Mul(residual, g.norm2), slope)));
    u = hn::IfThenElse(active, next, u);
    g = evaluate(a, s.gap0, s.gap1, u);
    // Quadratic: what is left after this step is the square of what was left before.
    active = hn::And(active, hn::Gt(hn::Abs(residual), all(3e-4f)));
    active = hn::And(active, hn::Or(hn::Gt(u, low), hn::Gt(g.norm2, one)));
    if (hn::AllFalse(f, active)) break;
  }
  // On the medial disk |w| < 1 even at the pole: the shortest axis takes the rest.
  const V across = hn::MulAdd(g.w.x, g.w.x, hn::Mul(g.w.y, g.w.y));
  const M medial = hn::Or(hn::And(hn::Le(u, low), hn::Lt(g.norm2, one)), hn::Eq(g.norm2, zero));
  const V rest = hn::Sqrt(hn::Max(zero, hn::Sub(one, across)));
  const V z = hn::IfThenElse(medial, hn::Max(rest, g.w.z), g.w.z);
  const V norm2 = hn::MulAdd(z, z, across);
  const V inverse = hn::Div(one, hn::Sqrt(norm2));
  return {hn::Mul(g.w.x, inverse), hn::Mul(g.w.y, inverse), hn::Mul(z, inverse)};
}

HWY_INLINE Foot foot_of(const Shape& s, V3 p) {
  const V3 q = p - s.center;
  Foot result;
  result.y = {dot(s.row0, q), dot(s.row1, q), dot(s.row2, q)};
  const V3 y = absolute(result.y);
  const V3 a = {y.x, hn::Mul(s.radius1, y.y), hn::Mul(s.radius2, y.z)};
  result.w = foot_direction(a, s, result.u);
  const V3 w = result.w;
  const V3 g = {w.x, hn::Mul(w.y, s.inverse1), hn::Mul(w.z, s.inverse2)};
  const V inverse = hn::Div(s.longest, hn::Sqrt(dot(g, g)));
  const V3 n = scaled(g, inverse);  // unit normal times r0, first octant
  const V3 foot = {w.x, hn::Mul(s.radius1, w.y), hn::Mul(s.radius2, w.z)};
  result.distance = dot(n, y - foot);
  const V3 m = {hn::CopySign(n.x, result.y.x), hn::CopySign(n.y, result.y.y), hn::CopySign(n.z, result.y.z)};
  result.normal = {hn::MulAdd(s.row0.x, m.x, hn::MulAdd(s.row1.x, m.y, hn::Mul(s.row2.x, m.z))),
                   hn::MulAdd(s.row0.y, m.x, hn::MulAdd(s.row1.y, m.y, hn::Mul(s.row2.y, m.z))),
                   hn::MulAdd(s.row0.z, m.x, hn::MulAdd(s.row1.z, m.y, hn::Mul(s.row2.z, m.z)))};
  return result;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
