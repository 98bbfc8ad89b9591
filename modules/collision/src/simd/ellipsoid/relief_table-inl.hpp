// Relief: the correction of an ellipsoid's distance and of its gradient, one closest point a lane.
#if defined(BODICE_COLLISION_RELIEF_TABLE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_RELIEF_TABLE_INL_
#undef BODICE_COLLISION_RELIEF_TABLE_INL_
#else
#define BODICE_COLLISION_RELIEF_TABLE_INL_
#endif

#include "model/relief_tables.hpp"
#include "simd/ellipsoid/shape-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// The table of each lane's ellipsoid: the members of BakedTable except its axes.
struct TableLanes {
  VI first_byte, nodes;
  V h_scale, h_offset, a_scale, a_offset;
};

HWY_INLINE TableLanes broadcast(const BakedTable& t) {
  return {hn::Set(I(), t.first_byte), hn::Set(I(), t.nodes), all(t.h_scale_m),
          all(t.h_offset_m),          all(t.a_scale),        all(t.a_offset)};
}

/// `column` reads the members of BakedTable by their index, another table in each lane.
template <class Column>
HWY_INLINE TableLanes table_from(const Column& column) {
  return {column.integer(0), column.integer(1), column(2), column(3), column(4), column(5)};
}

/// Reorders vectors between the proxy's axes, which tables use, and those by falling radius.
class AxisOrder {
 public:
  /// Takes the indices of the proxy's first two axes among the sorted ones.
  HWY_INLINE AxisOrder(VI axis0, VI axis1)
      : first0_(is(axis0, 0)),
        first1_(is(axis0, 1)),
        first2_(is(axis0, 2)),
        second0_(is(axis1, 0)),
        second1_(is(axis1, 1)),
        second2_(is(axis1, 2)) {}

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

/// A unit direction: its magnitudes and its sign bits. The map, like an ellipsoid, is the same in all octants
/// but for signs.
struct Direction {
  V3 w, sign;
};

/// The magnitudes of a direction on the octahedral square, with the terms that the chain rule needs; s =
/// |w_x| + |w_y| + |w_z|.
struct Octahedral {
  V x, y;            ///< in [0, 1]
  V flat_x, flat_y;  ///< w.x / s, w.y / s
  V inverse;         ///< 1 / s
};

/// Below the equator the square is folded outward.
HWY_INLINE Octahedral to_square(const Direction& d) {
  const V one = all(1.0f), below = d.sign.z;
  Octahedral o;
  o.inverse = reciprocal(hn::Add(d.w.x, hn::Add(d.w.y, d.w.z)));
  o.flat_x = hn::Mul(d.w.x, o.inverse);
  o.flat_y = hn::Mul(d.w.y, o.inverse);
  o.x = if_signed(below, hn::Sub(one, o.flat_y), o.flat_x);
  o.y = if_signed(below, hn::Sub(one, o.flat_x), o.flat_y);
  return o;
}

/// Slope over w of a function that has the slopes (gx, gy) over the magnitudes on the square.
HWY_INLINE V3 from_square(const Octahedral& o, V below, V gx, V gy) {
  const V sx = if_signed(below, hn::Neg(gy), gx);
  const V sy = if_signed(below, hn::Neg(gx), gy);
  const V radial = hn::MulAdd(sx, o.flat_x, hn::Mul(sy, o.flat_y));
  return scaled({hn::Sub(sx, radial), hn::Sub(sy, radial), hn::Neg(radial)}, o.inverse);
}

/// A bilinear value and its slopes on the square.
struct Bilinear {
  V value, gx, gy;
};

/// Byte kByte of each word.
template <int kByte>
HWY_INLINE V byte_of(VI word) {
  constexpr hn::RebindToUnsigned<I> unsigned_words;
  const auto shifted = hn::ShiftRight<8 * kByte>(hn::BitCast(unsigned_words, word));
  const auto byte = kByte == 3 ? shifted : hn::And(shifted, hn::Set(unsigned_words, 255));
  return hn::ConvertTo(f, hn::BitCast(I(), byte));
}

/// Twice a whole number below 2^23, as integers.
HWY_INLINE VI twice(V whole) {
  // The low bits of the sum are the number; a conversion would also handle numbers out of range.
  const VI sum = hn::BitCast(I(), hn::Add(whole, all(0x1p23f)));
  return hn::ShiftLeft<1>(hn::And(sum, hn::Set(I(), 0x7fffff)));
}

template <int kByte>
HWY_INLINE Bilinear bilinear(VI upper, VI lower, V u, V v, V scale, V offset) {
  const V p00 = byte_of<kByte>(upper), p10 = byte_of<kByte + 2>(upper);
  const V p01 = byte_of<kByte>(lower), p11 = byte_of<kByte + 2>(lower);
  const V along0 = hn::Sub(p10, p00), along1 = hn::Sub(p11, p01);
  const V row0 = hn::MulAdd(u, along0, p00), row1 = hn::MulAdd(u, along1, p01);
  const V down = hn::Sub(row1, row0);
  return {hn::MulAdd(scale, hn::MulAdd(v, down, row0), offset),
          hn::Mul(scale, hn::MulAdd(v, hn::Sub(along1, along0), along0)), hn::Mul(scale, down)};
}

/// What a table subtracts from the distance at a direction.
struct Correction {
  V value;         ///< h + a d, meters
  V3 slope;        ///< slope of the value over the direction in the first octant, meters
  V along_normal;  ///< 1 minus the slope of the value over the distance
  V burial;        ///< kappa b, meters; only where burial counts
};

/// kappa b in a cell that begins `first` bytes after the first pair (h, a).
HWY_INLINE V burial_in(const ReliefTables& relief, VI first, VI nodes, V u, V v) {
  const auto* base = reinterpret_cast<const std::int32_t*>(relief.burial.data());
  const VI texel = hn::ShiftRight<1>(first);
  const VI upper = hn::GatherOffset(I(), base, texel);
  const VI lower = hn::GatherOffset(I(), base, hn::Add(texel, nodes));
  const V p00 = byte_of<0>(upper), p10 = byte_of<1>(upper);
  const V p01 = byte_of<0>(lower), p11 = byte_of<1>(lower);
  const V row0 = hn::MulAdd(u, hn::Sub(p10, p00), p00), row1 = hn::MulAdd(u, hn::Sub(p11, p01), p01);
  return hn::Mul(all(relief.burial_m), hn::MulAdd(v, hn::Sub(row1, row0), row0));
}

/// The correction at a direction, given in the proxy's axes.
template <bool kBuries>
HWY_INLINE Correction correction(const ReliefTables& relief, const TableLanes& table, const Direction& at,
                                 V distance) {
  const Octahedral o = to_square(at);
  const V nodes = hn::ConvertTo(f, table.nodes);
  const V half = hn::MulSub(all(0.5f), nodes, all(0.5f)), last = hn::Sub(nodes, all(2.0f));
  const V column = hn::MulAdd(hn::Xor(o.x, at.sign.x), half, half);
  const V row = hn::MulAdd(hn::Xor(o.y, at.sign.y), half, half);
  const V i = hn::Max(hn::Zero(f), hn::Min(hn::Floor(column), last));
  const V j = hn::Max(hn::Zero(f), hn::Min(hn::Floor(row), last));
  const VI first = hn::Add(twice(hn::MulAdd(j, nodes, i)), table.first_byte);
  const auto* base = reinterpret_cast<const std::int32_t*>(relief.texels.data());
  const VI upper = hn::GatherOffset(I(), base, first);
  const VI lower = hn::GatherOffset(I(), base, hn::Add(first, hn::Add(table.nodes, table.nodes)));
  const V u = hn::Sub(column, i), v = hn::Sub(row, j);
  const Bilinear h = bilinear<0>(upper, lower, u, v, table.h_scale, table.h_offset);
  const Bilinear a = bilinear<1>(upper, lower, u, v, table.a_scale, table.a_offset);
  const V clamped = hn::Min(hn::Max(distance, all(-relief.in_m)), all(relief.out_m));
  const M moving = hn::Eq(clamped, distance);
  const V gx = hn::Mul(half, hn::MulAdd(a.gx, clamped, h.gx));
  const V gy = hn::Mul(half, hn::MulAdd(a.gy, clamped, h.gy));
  Correction by = {hn::MulAdd(a.value, clamped, h.value),
                   from_square(o, at.sign.z, hn::Xor(gx, at.sign.x), hn::Xor(gy, at.sign.y)),
                   hn::IfThenElse(moving, hn::Sub(all(1.0f), a.value), all(1.0f)), hn::Zero(f)};
  if constexpr (kBuries) by.burial = burial_in(relief, first, table.nodes, u, v);
  return by;
}

/// The corrected distance of one ellipsoid and its gradient.
struct Corrected {
  V value;      ///< F_k, meters
  V3 gradient;  ///< gradient of F_k, local frame of the collider
  V burial;     ///< as in Correction
};

/// The part of grad F_k that comes from h and a varying over the sphere, in the first octant. `slope` is d(h
/// + a d) / dw.
HWY_INLINE V3 tangential(const Shape& s, const ClosestPointLanes& closest, V3 slope) {
  const V3 w = closest.w;
  const V3 inverse = {reciprocal(hn::Add(closest.u, s.gap0)), reciprocal(hn::Add(closest.u, s.gap1)),
                      reciprocal(closest.u)};
  const V3 we = {hn::Mul(w.x, inverse.x), hn::Mul(w.y, inverse.y), hn::Mul(w.z, inverse.z)};
  const V ratio = hn::Mul(dot(slope, we), reciprocal(dot(w, we)));
  const V3 rest = {hn::NegMulAdd(w.x, ratio, slope.x), hn::NegMulAdd(w.y, ratio, slope.y),
                   hn::NegMulAdd(w.z, ratio, slope.z)};
  return {hn::Mul(inverse.x, rest.x), hn::Mul(hn::Mul(s.radius1, inverse.y), rest.y),
          hn::Mul(hn::Mul(s.radius2, inverse.z), rest.z)};
}

HWY_INLINE AxisOrder axes_of(const BakedTable& t) {
  return {hn::Set(I(), t.sorted_axis[0]), hn::Set(I(), t.sorted_axis[1])};
}

template <class Column>
HWY_INLINE AxisOrder axes_from(const Column& column) {
  return {column.integer(6), column.integer(7)};
}

/// Corrected distance F_k and its gradient. `read_axes` returns the order of the axes; it is called only if
/// they are not sorted.
template <bool kBuries, class ReadAxes>
HWY_INLINE Corrected corrected(const ReliefTables& relief, const TableLanes& table, const Shape& s,
                               const ClosestPointLanes& closest, ReadAxes&& read_axes) {
  const Direction at = {closest.w, signs_of(closest.y)};
  Correction by;
  if (relief.sorted_axes) {
    by = correction<kBuries>(relief, table, at, closest.distance);
  } else {
    const AxisOrder axes = read_axes();
    by = correction<kBuries>(relief, table, {axes.to_proxy(at.w), axes.to_proxy(at.sign)}, closest.distance);
    by.slope = axes.to_sorted(by.slope);
  }
  // out_of() divides by r0: that cancels the factor r0 of the normal, and the chain rule needs it in the
  // other term.
  const V3 gradient = scaled(closest.n, by.along_normal) - tangential(s, closest, by.slope);
  return {hn::Sub(closest.distance, by.value), out_of(s, with_signs(gradient, at.sign)), by.burial};
}

/// Weight of an ellipsoid where several blend: (max(0, 1 - (score - least) / blend))^2
HWY_INLINE V blend_weight(V distance, V least, V per_blend) {
  const V root = hn::Max(hn::Zero(f), hn::NegMulAdd(hn::Sub(distance, least), per_blend, all(1.0f)));
  return hn::Mul(root, root);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
