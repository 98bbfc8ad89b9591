// Relief: the correction of one ellipsoid's distance and its gradient, one foot a lane.
#if defined(BODICE_COLLISION_TABLE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_TABLE_INL_
#undef BODICE_COLLISION_TABLE_INL_
#else
#define BODICE_COLLISION_TABLE_INL_
#endif

#include "relief.hpp"
#include "simd/foot-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

HWY_INLINE V pick(V3 a, std::int32_t axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

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
  o.inverse = hn::Div(one, hn::Add(hn::Abs(w.x), hn::Add(hn::Abs(w.y), hn::Abs(w.z))));
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

struct Corrected {
  V value;      ///< F_k, metres
  V3 gradient;  ///< of F_k, local frame of the collider
};

/// The part of grad F_k that comes from h and a varying over the sphere: G is d(h + a d) / dw.
HWY_INLINE V3 tangential(const Shape& s, const Foot& foot, V3 w, V3 slope) {
  const V one = all(1.0f);
  const V3 inverse = {hn::Div(one, hn::Add(foot.u, s.gap0)), hn::Div(one, hn::Add(foot.u, s.gap1)),
                      hn::Div(one, foot.u)};
  const V3 we = {hn::Mul(w.x, inverse.x), hn::Mul(w.y, inverse.y), hn::Mul(w.z, inverse.z)};
  const V ratio = hn::Div(dot(slope, we), dot(w, we));
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

HWY_INLINE Corrected corrected(const ReliefTables& relief, const BakedTable& table, const Shape& s,
                               const Foot& foot) {
  if (table.nodes == 0) return {foot.distance, foot.normal};
  const V3 w = {hn::CopySign(foot.w.x, foot.y.x), hn::CopySign(foot.w.y, foot.y.y),
                hn::CopySign(foot.w.z, foot.y.z)};
  const Octahedral o = to_square(
      {pick(w, table.sorted_axis[0]), pick(w, table.sorted_axis[1]), pick(w, table.sorted_axis[2])});
  const float half = 0.5f * static_cast<float>(table.nodes - 1);
  const V last = all(static_cast<float>(table.nodes - 2));
  const V column = hn::MulAdd(o.x, all(half), all(half)), row = hn::MulAdd(o.y, all(half), all(half));
  const V i = hn::Max(hn::Zero(f), hn::Min(hn::Floor(column), last));
  const V j = hn::Max(hn::Zero(f), hn::Min(hn::Floor(row), last));
  const VI texel = hn::Add(hn::Mul(hn::ConvertTo(I(), j), hn::Set(I(), table.nodes)), hn::ConvertTo(I(), i));
  const VI at = hn::Add(hn::Add(texel, texel), hn::Set(I(), table.first_byte));
  const auto* base = reinterpret_cast<const std::int32_t*>(relief.texels.data());
  const VI upper = hn::GatherOffset(I(), base, at);
  const VI lower = hn::GatherOffset(I(), base, hn::Add(at, hn::Set(I(), 2 * table.nodes)));
  const V u = hn::Sub(column, i), v = hn::Sub(row, j);
  const Bilinear h = bilinear(upper, lower, 0, u, v, all(table.h_scale_m), all(table.h_offset_m));
  const Bilinear a = bilinear(upper, lower, 1, u, v, all(table.a_scale), all(table.a_offset));
  const V clamped = hn::Min(hn::Max(foot.distance, all(-relief.in_m)), all(relief.out_m));
  const M moving = hn::Eq(clamped, foot.distance);
  const V gx = hn::Mul(all(half), hn::MulAdd(a.gx, clamped, h.gx));
  const V gy = hn::Mul(all(half), hn::MulAdd(a.gy, clamped, h.gy));
  const V3 slope = from_square(o, gx, gy);
  V sorted[3];
  sorted[table.sorted_axis[0]] = slope.x;
  sorted[table.sorted_axis[1]] = slope.y;
  sorted[table.sorted_axis[2]] = slope.z;
  const V3 side = tangential(s, foot, w, {sorted[0], sorted[1], sorted[2]});
  const V along_normal = hn::IfThenElse(moving, hn::Sub(all(1.0f), a.value), all(1.0f));
  return {hn::Sub(foot.distance, hn::MulAdd(a.value, clamped, h.value)),
          scaled(foot.normal, along_normal) - side};
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
