// Vectors of floats and points, one a lane: V is a vector of floats, M a mask, VI a vector of integers, V3 a
// point a lane.
#if defined(BODICE_COLLISION_VEC3_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_VEC3_INL_
#undef BODICE_COLLISION_VEC3_INL_
#else
#define BODICE_COLLISION_VEC3_INL_
#endif

#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 16>;
using V = hn::Vec<F>;
using M = hn::Mask<F>;
using I = hn::RebindToSigned<F>;
using VI = hn::Vec<I>;
constexpr F f;
constexpr int kWidth = static_cast<int>(hn::MaxLanes(F()));
/// Vectors that are computed side by side, so that one proceeds while another waits for its results.
constexpr int kVectorsInStep = 2;
constexpr int kStep = kVectorsInStep * kWidth;  ///< lanes that are computed side by side

/// A point or vector in each lane.
struct V3 {
  V x, y, z;
};

HWY_INLINE V all(float value) {
  return hn::Set(f, value);
}
// Later releases of Highway have several targets of NEON, and a name for all of them.
#ifdef HWY_ALL_NEON
constexpr bool kIsNeon = (HWY_TARGET & HWY_ALL_NEON) != 0;
#else
constexpr bool kIsNeon = HWY_TARGET == HWY_NEON;
#endif
// Division and square root occupy a vector unit ten times as long as an estimate and a Newton step, which is
// exact to two roundings. Some targets have no estimate. v must be in [1e-37, 1e37].
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_WASM
HWY_INLINE V estimated_inverse_sqrt(V v) {
  return hn::Div(all(1.0f), hn::Sqrt(v));
}
HWY_INLINE V reciprocal(V v) {
  return hn::Div(all(1.0f), v);
}
HWY_INLINE V estimated_reciprocal(V v) {
  return reciprocal(v);
}
HWY_INLINE V inverse_sqrt(V v) {
  return estimated_inverse_sqrt(v);
}
#else
HWY_INLINE V newton_inverse_sqrt(V v, V r) {
  return hn::Mul(r, hn::NegMulAdd(hn::Mul(hn::Mul(all(0.5f), v), r), r, all(1.5f)));
}
/// 1 / sqrt(v) with relative error kEstimate, for bounds.
HWY_INLINE V estimated_inverse_sqrt(V v) {
  const V r = hn::ApproximateReciprocalSqrt(v);
  return kIsNeon ? newton_inverse_sqrt(v, r) : r;  // 8 bits at first instead of 12
}
HWY_INLINE V estimated_reciprocal(V v) {
  const V r = hn::ApproximateReciprocal(v);
  return kIsNeon ? hn::Mul(r, hn::NegMulAdd(v, r, all(2.0f))) : r;
}
HWY_INLINE V reciprocal(V v) {
  const V r = estimated_reciprocal(v);
  return hn::Mul(r, hn::NegMulAdd(v, r, all(2.0f)));
}
HWY_INLINE V inverse_sqrt(V v) {
  return newton_inverse_sqrt(v, estimated_inverse_sqrt(v));
}
#endif
#if HWY_TARGET == HWY_WASM
// Highway 1.0 looks up byte by byte, because engines before April 2021 had a fault in the one instruction for
// it (its comment in ops/wasm_128-inl.h).
using LaneIndices = VI;
HWY_INLINE LaneIndices lane_indices(VI lanes) {
  return hn::Add(hn::Mul(lanes, hn::Set(I(), 0x04040404)), hn::Set(I(), 0x03020100));
}
HWY_INLINE V lookup_lanes(V table, LaneIndices from) {
  return V{wasm_i8x16_swizzle(table.raw, from.raw)};
}
#else
using LaneIndices = decltype(hn::IndicesFromVec(f, VI()));
/// What lookup_lanes() takes; `lanes` must be from 0 to kWidth - 1.
HWY_INLINE LaneIndices lane_indices(VI lanes) {
  return hn::IndicesFromVec(f, lanes);
}
/// Returns, in each lane, the lane of the table that its index names.
HWY_INLINE V lookup_lanes(V table, LaneIndices from) {
  return hn::TableLookupLanes(table, from);
}
#endif
// Largest relative error of an estimate: 1.5 * 2^-12, and 2^-14 on targets with masks.
constexpr float kEstimate = HWY_TARGET == HWY_AVX3 ? 1e-4f : 5e-4f;

HWY_INLINE V3 operator+(V3 a, V3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator-(V3 a, V3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V dot(V3 a, V3 b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 scaled(V3 a, V s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
/// The sign bits alone, as zeros of either sign.
HWY_INLINE V3 signs_of(V3 a) {
  const V bit = hn::SignBit(f);
  return {hn::And(a.x, bit), hn::And(a.y, bit), hn::And(a.z, bit)};
}
/// `a`, negated where `signs` (of signs_of()) are negative.
HWY_INLINE V3 with_signs(V3 a, V3 signs) {
  return {hn::Xor(a.x, signs.x), hn::Xor(a.y, signs.y), hn::Xor(a.z, signs.z)};
}
/// Selects by the sign bit, which distinguishes the two zeros.
HWY_INLINE V if_signed(V sign, V yes, V no) {
  const auto word = [](V v) { return hn::BitCast(I(), v); };
  return hn::BitCast(f, hn::IfNegativeThenElse(word(sign), word(yes), word(no)));
}
/// a + s b
HWY_INLINE V3 add_scaled(V3 a, V s, V3 b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
HWY_INLINE V3 select(M m, V3 yes, V3 no) {
  return {hn::IfThenElse(m, yes.x, no.x), hn::IfThenElse(m, yes.y, no.y), hn::IfThenElse(m, yes.z, no.z)};
}
HWY_INLINE V3 absolute(V3 a) {
  return {hn::Abs(a.x), hn::Abs(a.y), hn::Abs(a.z)};
}
HWY_INLINE V3 unit(V3 a) {
  const V norm2 = dot(a, a);
  const M fine = hn::Gt(norm2, hn::Zero(f));
  const V inverse = hn::Div(all(1.0f), hn::Sqrt(hn::IfThenElse(fine, norm2, all(1.0f))));
  return scaled(a, inverse);
}
HWY_INLINE V3 load3(const float* x, const float* y, const float* z) {
  return {hn::Load(f, x), hn::Load(f, y), hn::Load(f, z)};
}
HWY_INLINE V3 gather3(const float* x, const float* y, const float* z, VI at) {
  return {hn::GatherIndex(f, x, at), hn::GatherIndex(f, y, at), hn::GatherIndex(f, z, at)};
}
HWY_INLINE V3 broadcast3(const float* xyz) {
  return {all(xyz[0]), all(xyz[1]), all(xyz[2])};
}
/// The lanes first, first + 1, ...; hn::Iota would store them one by one and stall on reading them.
HWY_INLINE VI lanes_from(int first) {
  alignas(64) static constexpr std::int32_t kLanes[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                          8, 9, 10, 11, 12, 13, 14, 15};
  return hn::Add(hn::Load(I(), kLanes), hn::Set(I(), first));
}
/// Mask of the lanes i, i + 1, ... that are below the end.
HWY_INLINE M lanes_below(int i, int end) {
  return hn::FirstN(f, static_cast<std::size_t>(end > i ? end - i : 0));
}
/// The mask as bits, lane 0 lowest.
HWY_INLINE std::uint64_t bits(M m) {
  std::uint8_t bytes[8] = {};
  (void)hn::StoreMaskBits(f, m, bytes);
  std::uint64_t result;
  std::memcpy(&result, bytes, sizeof(result));
  return result;
}
HWY_INLINE void store3(V3 a, float* x, float* y, float* z) {
  hn::Store(a.x, f, x);
  hn::Store(a.y, f, y);
  hn::Store(a.z, f, z);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
