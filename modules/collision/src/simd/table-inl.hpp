// Relief: the correction of one ellipsoid's distance and its gradient, one foot a lane.
#if defined(BODICE_COLLISION_TABLE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_TABLE_INL_
#undef BODICE_COLLISION_TABLE_INL_
#else
#define BODICE_COLLISION_TABLE_INL_
#endif

#include "relief.hpp"
#include "simd/lookup-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The table of each lane's ellipsoid: the members of BakedTable.
struct TableLanes {
  VI first_byte, nodes, axis0, axis1;
  V h_scale, h_offset, a_scale, a_offset;
};

HWY_INLINE TableLanes broadcast(const BakedTable& t) {
  return {hn::Set(I(), t.first_byte),
          hn::Set(I(), t.nodes),
          hn::Set(I(), t.sorted_axis[0]),
          hn::Set(I(), t.sorted_axis[1]),
          all(t.h_scale_m),
          all(t.h_offset_m),
          all(t.a_scale),
          all(t.a_offset)};
}

template <int kTables>
HWY_INLINE TableLanes table_of(const Columns& columns, VI column) {
  const Lookup<kTables> at(column);
  const auto number = [&](int i) { return at(columns.row(Columns::kTable + i)); };
  const auto integer = [&](int i) { return hn::BitCast(I(), at(columns.row(Columns::kTable + i))); };
  return {integer(0), integer(1), integer(6), integer(7), number(2), number(3), number(4), number(5)};
}

/// Between the axes of the proxy, which the table is over, and those by falling radius.
class AxisOrder {
 public:
  explicit HWY_INLINE AxisOrder(const TableLanes& t)
      : first0_(is(t.axis0, 0)),
        first1_(is(t.axis0, 1)),
        first2_(is(t.axis0, 2)),
        second0_(is(t.axis1, 0)),
        second1_(is(t.axis1, 1)),
        second2_(is(t.axis1, 2)) {}

  HWY_INLINE V3 to_proxy(V3 sorted) const {
    return {choose(first0_, first1_, sorted.x, sorted.y, sorted.z),
            choose(second0_, second1_, sorted.x, sorted.y, sorted.z),
            choose(hn::Not(hn::Or(first0_, second0_)), hn::Not(hn::Or(first1_, second1_)), sorted.x, sorted.y,
                   sorted.z)};
  }
  HWY_INLINE V3 to_sorted(V3 proxy) const {
    return {choose(first0_, second0_, proxy.x, proxy.y, proxy.z),
            choose(first1_, second1_, proxy.x, proxy.y, proxy.z),
            choose(first2_, second2_, proxy.x, proxy.y, proxy.z)};
  }

 private:
  static HWY_INLINE M is(VI axis, std::int32_t which) {
    return hn::RebindMask(f, hn::Eq(axis, hn::Set(I(), which)));
  }
  static HWY_INLINE V choose(M a, M b, V if_a, V if_b, V otherwise) {
    return hn::IfThenElse(a, if_a, hn::IfThenElse(b, if_b, otherwise));
  }

  M first0_, first1_, first2_, second0_, second1_, second2_;
};

/// sign(v) with sign(0) = +1.
HWY_INLINE V sign_of(V v) {
  return hn::CopySign(all(1.0f), v);
}

/// A direction on the octahedral square, with what the chain rule needs to come back.
struct Octahedral {
  V x, y;            ///< in [-1, 1]
  V flat_x, flat_y;  ///< w.x / s, w.y / s
  V inverse;         ///< 1 / s
  V3 sign;
  M below;  ///< w.z < 0: folded outward
};

HWY_INLINE Octahedral to_square(V3 w) {
  const V one = all(1.0f);
  Octahedral o;
  o.sign = {sign_of(w.x), sign_of(w.y), sign_of(w.z)};
  o.inverse = reciprocal(hn::Add(hn::Abs(w.x), hn::Add(hn::Abs(w.y), hn::Abs(w.z))));
  o.flat_x = hn::Mul(w.x, o.inverse);
  o.flat_y = hn::Mul(w.y, o.inverse);
  o.below = hn::Lt(w.z, hn::Zero(f));
  o.x = hn::IfThenElse(o.below, hn::Mul(hn::Sub(one, hn::Abs(o.flat_y)), o.sign.x), o.flat_x);
  o.y = hn::IfThenElse(o.below, hn::Mul(hn::Sub(one, hn::Abs(o.flat_x)), o.sign.y), o.flat_y);
  return o;
}

/// d/dw of a function whose slopes on the square are (gx, gy).
HWY_INLINE V3 from_square(const Octahedral& o, V gx, V gy) {
  const V fold = hn::Neg(hn::Mul(o.sign.x, o.sign.y));
  const V sx = hn::IfThenElse(o.below, hn::Mul(fold, gy), gx);
  const V sy = hn::IfThenElse(o.below, hn::Mul(fold, gx), gy);
  const V radial = hn::MulAdd(sx, o.flat_x, hn::Mul(sy, o.flat_y));
  return {hn::Mul(o.inverse, hn::NegMulAdd(radial, o.sign.x, sx)),
          hn::Mul(o.inverse, hn::NegMulAdd(radial, o.sign.y, sy)),
          hn::Mul(o.inverse, hn::NegMulAdd(radial, o.sign.z, hn::Zero(f)))};
}

/// A bilinear value and its slopes on the square.
struct Bilinear {
  V value, gx, gy;
};

HWY_INLINE V byte_of(VI word, int which) {
  return hn::ConvertTo(f, hn::And(hn::ShiftRightSame(word, 8 * which), hn::Set(I(), 255)));
}

HWY_INLINE Bilinear bilinear(VI upper, VI lower, int byte, V u, V v, V scale, V offset) {
  const V p00 = byte_of(upper, byte), p10 = byte_of(upper, byte + 2);
  const V p01 = byte_of(lower, byte), p11 = byte_of(lower, byte + 2);
  const V along0 = hn::Sub(p10, p00), along1 = hn::Sub(p11, p01);
  const V row0 = hn::MulAdd(u, along0, p00), row1 = hn::MulAdd(u, along1, p01);
  const V down = hn::Sub(row1, row0);
  return {hn::MulAdd(scale, hn::MulAdd(v, down, row0), offset),
          hn::Mul(scale, hn::MulAdd(v, hn::Sub(along1, along0), along0)), hn::Mul(scale, down)};
}

/// What a table takes off the distance at a direction.
struct Correction {
  V value;         ///< h + a d, metres
  V3 slope;        ///< its slope over the direction, axes of the proxy, metres
  V along_normal;  ///< 1 less its slope over the distance
};

/// `w`: axes of the proxy, unit.
HWY_INLINE Correction correction(const ReliefTables& relief, const TableLanes& table, V3 w, V distance) {
  const Octahedral o = to_square(w);
  const V nodes = hn::ConvertTo(f, table.nodes);
  const V half = hn::MulSub(all(0.5f), nodes, all(0.5f)), last = hn::Sub(nodes, all(2.0f));
  const V column = hn::MulAdd(o.x, half, half), row = hn::MulAdd(o.y, half, half);
  const V i = hn::Max(hn::Zero(f), hn::Min(hn::Floor(column), last));
  const V j = hn::Max(hn::Zero(f), hn::Min(hn::Floor(row), last));
  const VI texel = hn::ConvertTo(I(), hn::MulAdd(j, nodes, i));  // exact: below 2^24
  const VI at = hn::Add(hn::Add(texel, texel), table.first_byte);
  const auto* base = reinterpret_cast<const std::int32_t*>(relief.texels.data());
  const VI upper = hn::GatherOffset(I(), base, at);
  const VI lower = hn::GatherOffset(I(), base, hn::Add(at, hn::Add(table.nodes, table.nodes)));
  const V u = hn::Sub(column, i), v = hn::Sub(row, j);
  const Bilinear h = bilinear(upper, lower, 0, u, v, table.h_scale, table.h_offset);
  const Bilinear a = bilinear(upper, lower, 1, u, v, table.a_scale, table.a_offset);
  const V clamped = hn::Min(hn::Max(distance, all(-relief.in_m)), all(relief.out_m));
  const M moving = hn::Eq(clamped, distance);
  const V gx = hn::Mul(half, hn::MulAdd(a.gx, clamped, h.gx));
  const V gy = hn::Mul(half, hn::MulAdd(a.gy, clamped, h.gy));
  return {hn::MulAdd(a.value, clamped, h.value), from_square(o, gx, gy),
          hn::IfThenElse(moving, hn::Sub(all(1.0f), a.value), all(1.0f))};
}

struct Corrected {
  V value;      ///< F_k, metres
  V3 gradient;  ///< of F_k, local frame of the collider
};

/// The part of grad F_k that comes from h and a varying over the sphere: G is d(h + a d) / dw.
HWY_INLINE V3 tangential(const Shape& s, const Foot& foot, V3 w, V3 slope) {
  const V3 inverse = {reciprocal(hn::Add(foot.u, s.gap0)), reciprocal(hn::Add(foot.u, s.gap1)),
                      reciprocal(foot.u)};
  const V3 we = {hn::Mul(w.x, inverse.x), hn::Mul(w.y, inverse.y), hn::Mul(w.z, inverse.z)};
  const V ratio = hn::Mul(dot(slope, we), reciprocal(dot(w, we)));
  const V3 rest = {hn::NegMulAdd(w.x, ratio, slope.x), hn::NegMulAdd(w.y, ratio, slope.y),
                   hn::NegMulAdd(w.z, ratio, slope.z)};
  const V x = hn::Mul(inverse.x, rest.x);
  const V y = hn::Mul(hn::Mul(s.radius1, inverse.y), rest.y);
  const V z = hn::Mul(hn::Mul(s.radius2, inverse.z), rest.z);
  // The rows of to_unit are axes / r0, which is the 1 / r0 that the chain rule asks for.
  return {hn::MulAdd(s.row0.x, x, hn::MulAdd(s.row1.x, y, hn::Mul(s.row2.x, z))),
          hn::MulAdd(s.row0.y, x, hn::MulAdd(s.row1.y, y, hn::Mul(s.row2.y, z))),
          hn::MulAdd(s.row0.z, x, hn::MulAdd(s.row1.z, y, hn::Mul(s.row2.z, z)))};
}

HWY_INLINE Corrected corrected(const ReliefTables& relief, const TableLanes& table, const Shape& s,
                               const Foot& foot) {
  const AxisOrder axes(table);
  const V3 w = {hn::CopySign(foot.w.x, foot.y.x), hn::CopySign(foot.w.y, foot.y.y),
                hn::CopySign(foot.w.z, foot.y.z)};
  const Correction by = correction(relief, table, axes.to_proxy(w), foot.distance);
  const V3 side = tangential(s, foot, w, axes.to_sorted(by.slope));
  return {hn::Sub(foot.distance, by.value), scaled(foot.normal, by.along_normal) - side};
}

/// An ellipsoid's share where several blend: (max(0, 1 - (d - least) / blend))^2
HWY_INLINE V blend_weight(V distance, V least, V per_blend) {
  const V root = hn::Max(hn::Zero(f), hn::NegMulAdd(hn::Sub(distance, least), per_blend, all(1.0f)));
  return hn::Mul(root, root);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
