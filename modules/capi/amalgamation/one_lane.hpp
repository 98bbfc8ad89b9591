// What the kernels use of Highway, with one lane: for compilers without its headers. Comparisons with NaN are
// false, and of two numbers the least and the largest is the one that is not NaN, as Highway has it.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#define HWY_SCALAR (1 << 29)
#define HWY_EMU128 (1 << 28)
#define HWY_NEON (1 << 27)
#define HWY_SSE4 (1 << 26)
#define HWY_AVX2 (1 << 25)
#define HWY_AVX3 (1 << 24)
#define HWY_STATIC_TARGET HWY_SCALAR
#define HWY_WASM (1 << 23)
#define HWY_TARGETS HWY_SCALAR
#define HWY_TARGET HWY_SCALAR
#define HWY_ONCE 1
#define HWY_NAMESPACE N_ONE_LANE
#define HWY_BEFORE_NAMESPACE() static_assert(true, "")
#define HWY_AFTER_NAMESPACE() static_assert(true, "")
#define HWY_EXPORT(function) static_assert(true, "")
#define HWY_DYNAMIC_DISPATCH(function) N_ONE_LANE::function
#define HWY_RESTRICT
#if defined(_MSC_VER) && !defined(__clang__)
#define HWY_INLINE __forceinline
#define HWY_NOINLINE __declspec(noinline)
#define HWY_LIKELY(condition) (condition)
#define HWY_UNLIKELY(condition) (condition)
#else
#define HWY_INLINE inline __attribute__((always_inline))
#define HWY_NOINLINE __attribute__((noinline))
#define HWY_LIKELY(condition) __builtin_expect(!!(condition), 1)
#define HWY_UNLIKELY(condition) __builtin_expect(!!(condition), 0)
#endif

namespace hwy {

inline const char* TargetName(int) {
  return "one lane";
}
template <class T>
HWY_INLINE void Prefetch(const T*) {}

namespace N_ONE_LANE {

template <class T_>
struct One {
  using T = T_;
};
template <class T>
struct Lane {
  T raw;
};
template <class T>
struct Flag {
  bool raw;
};

template <class T, std::size_t>
using CappedTag = One<T>;
template <class T, std::size_t>
using FixedTag = One<T>;
template <class D>
using Vec = Lane<typename D::T>;
template <class D>
using Mask = Flag<typename D::T>;
template <class T, class D>
using Rebind = One<T>;
template <class D>
using Half = D;
template <class T>
using SignedOf = std::conditional_t<sizeof(T) == 4, std::int32_t,
                                    std::conditional_t<sizeof(T) == 2, std::int16_t, std::int8_t>>;
template <class D>
using RebindToSigned = One<SignedOf<typename D::T>>;
template <class D>
using RebindToUnsigned = One<std::make_unsigned_t<SignedOf<typename D::T>>>;
template <class T>
using Word = std::make_unsigned_t<SignedOf<T>>;

template <class D>
constexpr std::size_t Lanes(D) {
  return 1;
}
template <class D>
constexpr std::size_t MaxLanes(D) {
  return 1;
}

template <class D, class T>
HWY_INLINE Vec<D> Set(D, T value) {
  return {static_cast<typename D::T>(value)};
}
template <class D>
HWY_INLINE Vec<D> Zero(D) {
  return {};
}
template <class D, class T>
HWY_INLINE Vec<D> Iota(D, T first) {
  return {static_cast<typename D::T>(first)};
}
template <class T>
HWY_INLINE T GetLane(Lane<T> v) {
  return v.raw;
}
template <class D, class T>
HWY_INLINE Vec<D> BitCast(D, Lane<T> v) {
  return {std::bit_cast<typename D::T>(v.raw)};
}

// -- memory
template <class D, class T>
HWY_INLINE Vec<D> Load(D, const T* from) {
  Vec<D> v;
  std::memcpy(&v.raw, from, sizeof v.raw);
  return v;
}
template <class D, class T>
HWY_INLINE Vec<D> LoadU(D d, const T* from) {
  return Load(d, from);
}
template <class D, class T>
HWY_INLINE Vec<D> MaskedLoad(Mask<D> m, D d, const T* from) {
  return m.raw ? Load(d, from) : Zero(d);
}
template <class T, class D>
HWY_INLINE void Store(Lane<T> v, D, T* to) {
  std::memcpy(to, &v.raw, sizeof v.raw);
}
template <class T, class D>
HWY_INLINE void StoreU(Lane<T> v, D d, T* to) {
  Store(v, d, to);
}
template <class D, class T>
HWY_INLINE Vec<D> GatherIndex(D, const T* from, Lane<std::int32_t> at) {
  return {from[at.raw]};
}
template <class D, class T>
HWY_INLINE Vec<D> GatherOffset(D d, const T* from, Lane<std::int32_t> bytes) {
  return Load(d, reinterpret_cast<const T*>(reinterpret_cast<const char*>(from) + bytes.raw));
}
template <class T>
HWY_INLINE Lane<T> Compress(Lane<T> v, Flag<T>) {
  return v;
}
template <class T, class D>
HWY_INLINE void StoreInterleaved4(Lane<T> a, Lane<T> b, Lane<T> c, Lane<T> e, D, T* to) {
  to[0] = a.raw, to[1] = b.raw, to[2] = c.raw, to[3] = e.raw;
}
template <class D, class T>
HWY_INLINE void LoadInterleaved4(D, const T* from, Lane<T>& a, Lane<T>& b, Lane<T>& c, Lane<T>& e) {
  a.raw = from[0], b.raw = from[1], c.raw = from[2], e.raw = from[3];
}
template <class D>
HWY_INLINE Lane<std::int32_t> IndicesFromVec(D, Lane<std::int32_t> at) {
  return at;
}
template <class T>
HWY_INLINE Lane<T> TableLookupLanes(Lane<T> v, Lane<std::int32_t>) {
  return v;
}

// -- arithmetic
template <class T>
HWY_INLINE Lane<T> Add(Lane<T> a, Lane<T> b) {
  return {static_cast<T>(a.raw + b.raw)};
}
template <class T>
HWY_INLINE Lane<T> Sub(Lane<T> a, Lane<T> b) {
  return {static_cast<T>(a.raw - b.raw)};
}
template <class T>
HWY_INLINE Lane<T> Mul(Lane<T> a, Lane<T> b) {
  return {static_cast<T>(a.raw * b.raw)};
}
template <class T>
HWY_INLINE Lane<T> Div(Lane<T> a, Lane<T> b) {
  return {a.raw / b.raw};
}
template <class T>
HWY_INLINE Lane<T> Neg(Lane<T> a) {
  return {static_cast<T>(-a.raw)};
}
template <class T>
HWY_INLINE Lane<T> Abs(Lane<T> a) {
  return {static_cast<T>(std::abs(a.raw))};
}
template <class T>
HWY_INLINE Lane<T> Sqrt(Lane<T> a) {
  return {std::sqrt(a.raw)};
}
template <class T>
HWY_INLINE Lane<T> Floor(Lane<T> a) {
  return {std::floor(a.raw)};
}
template <class T>
HWY_INLINE Lane<T> MulAdd(Lane<T> a, Lane<T> b, Lane<T> c) {
  return Add(Mul(a, b), c);
}
template <class T>
HWY_INLINE Lane<T> NegMulAdd(Lane<T> a, Lane<T> b, Lane<T> c) {
  return Sub(c, Mul(a, b));
}
template <class T>
HWY_INLINE Lane<T> MulSub(Lane<T> a, Lane<T> b, Lane<T> c) {
  return Sub(Mul(a, b), c);
}
template <class T>
HWY_INLINE Lane<T> Min(Lane<T> a, Lane<T> b) {
  if (a.raw != a.raw) return b;
  return b.raw < a.raw ? b : a;
}
template <class T>
HWY_INLINE Lane<T> Max(Lane<T> a, Lane<T> b) {
  if (a.raw != a.raw) return b;
  return b.raw > a.raw ? b : a;
}
template <class D, class T>
HWY_INLINE Lane<T> MinOfLanes(D, Lane<T> a) {
  return a;
}
template <class D, class T>
HWY_INLINE Lane<T> MaxOfLanes(D, Lane<T> a) {
  return a;
}
template <int kBits, class T>
HWY_INLINE Lane<T> ShiftLeft(Lane<T> a) {
  return {static_cast<T>(static_cast<Word<T>>(a.raw) << kBits)};
}
template <int kBits, class T>
HWY_INLINE Lane<T> ShiftRight(Lane<T> a) {
  return {static_cast<T>(a.raw >> kBits)};
}
template <class D, class T>
HWY_INLINE Vec<D> ConvertTo(D, Lane<T> a) {
  return {static_cast<typename D::T>(a.raw)};
}
template <class D, class T>
HWY_INLINE Vec<D> PromoteTo(D, Lane<T> a) {
  return {static_cast<typename D::T>(a.raw)};
}

}  // namespace N_ONE_LANE
}  // namespace hwy
