// Particles as four floats. A particle is read by one load; separate arrays would take four gathers.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include <bodice/geometry/detail/float4.hpp>

namespace bodice::inline v0_1::cloth {

using geometry::any;
using geometry::Float4;
using geometry::Int4;
using geometry::lane_bits;
using geometry::max;
using geometry::min;
using geometry::square_root;

/// A particle as constraints read it.
struct alignas(16) Point {
  float x = 0.0f, y = 0.0f, z = 0.0f;  ///< meters
  float weight = 0.0f;                 ///< inverse mass; 0: the particle is pinned or asleep
};

/// The upper half of a float (bfloat16): its range with three digits, which suffice for constants of fabrics.
enum class Half : std::uint16_t {};

/// Rounds a finite value to the nearest Half.
inline Half to_half(double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  return Half{static_cast<std::uint16_t>((bits + 0x8000u) >> 16)};
}
inline float to_float(Half half) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 16);
}

inline Float4 load(const Point& p) {
  Float4 v;
  std::memcpy(&v, &p, sizeof v);
  return v;
}
inline Float4 load(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
inline void store(Point& p, Float4 v) {
  std::memcpy(static_cast<void*>(&p), &v, sizeof v);
}
inline void store(float* p, Float4 v) {
  std::memcpy(p, &v, sizeof v);
}
inline Float4 splat(float s) {
  return Float4{s, s, s, s};
}

/// The point with its weight set to zero.
inline Float4 xyz(Float4 v) {
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(v) & Int4{-1, -1, -1, 0});
}

/// The scalar product of vectors; the fourth lane is not used.
inline float dot(Float4 a, Float4 b) {
  const Float4 ab = a * b;
  return ab[0] + ab[1] + ab[2];
}

/// The vector product of vectors; the fourth lane is not used, and zero in the result.
inline Float4 cross(Float4 a, Float4 b) {
  return Float4{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0f};
}

/// A vector turned by a rotation vector of less than a radian, to second order.
inline Float4 turned(Float4 v, Float4 by_rad) {
  const Float4 first = cross(by_rad, v);
  return v + first + 0.5f * cross(by_rad, first);
}

inline void transpose(Float4& a, Float4& b, Float4& c, Float4& d) {
  const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// The weights of four points.
inline Float4 weights(Float4 a, Float4 b, Float4 c, Float4 d) {
  const Float4 ab = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

}  // namespace bodice::cloth
