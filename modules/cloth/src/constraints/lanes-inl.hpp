// Vectors of eight constraints with AVX2, and of four otherwise. A vector consists of one or two blocks of
// four lanes, each as wide as a particle: block b of row k belongs to constraint 4 b + k.
#if defined(BODICE_CLOTH_LANES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_CLOTH_LANES_INL_
#undef BODICE_CLOTH_LANES_INL_
#else
#define BODICE_CLOTH_LANES_INL_
#endif

#include <hwy/highway.h>

#include "base/particles.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::cloth::HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2

using Lanes = float __attribute__((vector_size(32)));
constexpr std::size_t kLanes = 8;

HWY_INLINE Lanes read(const float* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
HWY_INLINE void write(float* to, Lanes v) {
  std::memcpy(to, &v, sizeof v);
}
template <class Id>
HWY_INLINE Lanes read_points(const Point* p, const Id* id) {
  return __builtin_shufflevector(load(p[id[0]]), load(p[id[4]]), 0, 1, 2, 3, 4, 5, 6, 7);
}
template <class Id>
HWY_INLINE void write_points(Point* p, const Id* id, Lanes v) {
  store(p[id[0]], __builtin_shufflevector(v, v, 0, 1, 2, 3));
  store(p[id[4]], __builtin_shufflevector(v, v, 4, 5, 6, 7));
}
/// Copies lane k of each block to all lanes of the block.
template <int k>
HWY_INLINE Lanes spread(Lanes v) {
  return __builtin_shufflevector(v, v, k, k, k, k, 4 + k, 4 + k, 4 + k, 4 + k);
}
HWY_INLINE Lanes without_weight(Lanes v) {
  using Bits = int __attribute__((vector_size(32)));
  return reinterpret_cast<Lanes>(reinterpret_cast<Bits>(v) & Bits{-1, -1, -1, 0, -1, -1, -1, 0});
}
HWY_INLINE Lanes square_root(Lanes v) {
  return _mm256_sqrt_ps(v);
}
HWY_INLINE void transpose_blocks(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes ab_high = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const Lanes cd_high = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
}
/// The weights of four rows of points.
HWY_INLINE Lanes weights_of(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
}

#else

using Lanes = Float4;
constexpr std::size_t kLanes = 4;

HWY_INLINE Lanes read(const float* from) {
  return load(from);
}
HWY_INLINE void write(float* to, Lanes v) {
  store(to, v);
}
template <class Id>
HWY_INLINE Lanes read_points(const Point* p, const Id* id) {
  return load(p[*id]);
}
template <class Id>
HWY_INLINE void write_points(Point* p, const Id* id, Lanes v) {
  store(p[*id], v);
}
template <int k>
HWY_INLINE Lanes spread(Lanes v) {
  return __builtin_shufflevector(v, v, k, k, k, k);
}
HWY_INLINE Lanes without_weight(Lanes v) {
  return xyz(v);
}
HWY_INLINE Lanes square_root(Lanes v) {
  return geometry::square_root(v);
}
HWY_INLINE void transpose_blocks(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  transpose(a, b, c, d);
}
HWY_INLINE Lanes weights_of(Lanes a, Lanes b, Lanes c, Lanes d) {
  return weights(a, b, c, d);
}

#endif

HWY_INLINE Lanes read(const Half* from) {
  using Halves = std::uint16_t __attribute__((vector_size(2 * kLanes)));
  using Bits = std::uint32_t __attribute__((vector_size(4 * kLanes)));
  Halves halves;
  std::memcpy(&halves, from, sizeof halves);
  return reinterpret_cast<Lanes>(__builtin_convertvector(halves, Bits) << 16);
}
HWY_INLINE Lanes all(float s) {
  return s - Lanes{};
}
HWY_INLINE Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
HWY_INLINE Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}
HWY_INLINE float sum(Lanes v) {
  float out = 0.0f;
  for (std::size_t k = 0; k < kLanes; ++k) out += v[k];
  return out;
}

}  // namespace bodice::cloth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
