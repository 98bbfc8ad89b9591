// Bits and masks of one lane; one_lane.hpp comes before.
namespace hwy {
namespace N_ONE_LANE {

// -- bits
template <class T, class Combine>
HWY_INLINE Lane<T> by_bits(Lane<T> a, Lane<T> b, Combine combine) {
  return {std::bit_cast<T>(
      static_cast<Word<T>>(combine(std::bit_cast<Word<T>>(a.raw), std::bit_cast<Word<T>>(b.raw))))};
}
template <class T>
HWY_INLINE Lane<T> And(Lane<T> a, Lane<T> b) {
  return by_bits(a, b, [](auto x, auto y) { return x & y; });
}
template <class T>
HWY_INLINE Lane<T> AndNot(Lane<T> a, Lane<T> b) {
  return by_bits(a, b, [](auto x, auto y) { return ~x & y; });
}
template <class T>
HWY_INLINE Lane<T> Or(Lane<T> a, Lane<T> b) {
  return by_bits(a, b, [](auto x, auto y) { return x | y; });
}
template <class T>
HWY_INLINE Lane<T> Xor(Lane<T> a, Lane<T> b) {
  return by_bits(a, b, [](auto x, auto y) { return x ^ y; });
}
template <class T>
HWY_INLINE Lane<T> Not(Lane<T> a) {
  return by_bits(a, a, [](auto x, auto) { return ~x; });
}
template <class D>
HWY_INLINE Vec<D> SignBit(D) {
  return {std::bit_cast<typename D::T>(
      static_cast<Word<typename D::T>>(Word<typename D::T>{1} << (8 * sizeof(typename D::T) - 1)))};
}

// -- masks
template <class T>
HWY_INLINE Flag<T> And(Flag<T> a, Flag<T> b) {
  return {a.raw && b.raw};
}
template <class T>
HWY_INLINE Flag<T> AndNot(Flag<T> a, Flag<T> b) {
  return {!a.raw && b.raw};
}
template <class T>
HWY_INLINE Flag<T> Or(Flag<T> a, Flag<T> b) {
  return {a.raw || b.raw};
}
template <class T>
HWY_INLINE Flag<T> Xor(Flag<T> a, Flag<T> b) {
  return {a.raw != b.raw};
}
template <class T>
HWY_INLINE Flag<T> Not(Flag<T> a) {
  return {!a.raw};
}
template <class T>
HWY_INLINE Flag<T> Eq(Lane<T> a, Lane<T> b) {
  return {a.raw == b.raw};
}
template <class T>
HWY_INLINE Flag<T> Lt(Lane<T> a, Lane<T> b) {
  return {a.raw < b.raw};
}
template <class T>
HWY_INLINE Flag<T> Le(Lane<T> a, Lane<T> b) {
  return {a.raw <= b.raw};
}
template <class T>
HWY_INLINE Flag<T> Gt(Lane<T> a, Lane<T> b) {
  return {a.raw > b.raw};
}
template <class T>
HWY_INLINE Flag<T> Ge(Lane<T> a, Lane<T> b) {
  return {a.raw >= b.raw};
}
template <class D, class T>
HWY_INLINE Mask<D> RebindMask(D, Flag<T> m) {
  return {m.raw};
}
template <class D>
HWY_INLINE Mask<D> FirstN(D, std::size_t n) {
  return {n > 0};
}
template <class D, class T>
HWY_INLINE bool AllTrue(D, Flag<T> m) {
  return m.raw;
}
template <class D, class T>
HWY_INLINE bool AllFalse(D, Flag<T> m) {
  return !m.raw;
}
template <class D, class T>
HWY_INLINE std::size_t CountTrue(D, Flag<T> m) {
  return m.raw;
}
template <class D, class T>
HWY_INLINE std::intptr_t FindFirstTrue(D, Flag<T> m) {
  return m.raw ? 0 : -1;
}
template <class D>
HWY_INLINE Mask<D> LoadMaskBits(D, const std::uint8_t* bits) {
  return {(*bits & 1) != 0};
}
template <class D, class T>
HWY_INLINE std::size_t StoreMaskBits(D, Flag<T> m, std::uint8_t* bits) {
  *bits = m.raw;
  return 1;
}
template <class T>
HWY_INLINE Lane<T> IfThenElse(Flag<T> m, Lane<T> yes, Lane<T> no) {
  return m.raw ? yes : no;
}
template <class T>
HWY_INLINE Lane<T> IfThenElseZero(Flag<T> m, Lane<T> yes) {
  return m.raw ? yes : Lane<T>{};
}
template <class T>
HWY_INLINE Lane<T> IfThenZeroElse(Flag<T> m, Lane<T> no) {
  return m.raw ? Lane<T>{} : no;
}
template <class T>
HWY_INLINE Lane<T> IfNegativeThenElse(Lane<T> sign, Lane<T> yes, Lane<T> no) {
  return sign.raw < 0 ? yes : no;
}

}  // namespace N_ONE_LANE
}  // namespace hwy
