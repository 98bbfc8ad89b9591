// Vectors of as many floats as a bundle has nodes: loops that become vector code, or the compiler's own
// vectors.
#pragma once

#include <cstring>

#include <bodice/geometry/detail/float4.hpp>
#include <bodice/proxy/binding.hpp>

namespace bodice::inline v0_1::binding {

inline constexpr int kLanes = proxy::kBundle;
using Lanes = float[kLanes];

/// The larger value, b if either is NaN. Unlike std::max, which takes references, it is one instruction of
/// vector code.
inline float greater(float a, float b) {
  return a > b ? a : b;
}
/// The smaller value, b if either is NaN.
inline float lesser(float a, float b) {
  return a < b ? a : b;
}

// Always part of the caller, so that it is compiled for the caller's instructions.
#define BODICE_LANES inline __attribute__((always_inline))

/// Lanes as a value. The compiler divides it into as many registers as the instruction set needs. Functions
/// take it by reference: by value, its ABI depends on the instruction set.
using Vector = float __attribute__((vector_size(sizeof(float) * kLanes)));

BODICE_LANES void load(const float* lanes, Vector& to) {
  std::memcpy(&to, lanes, sizeof(to));
}
BODICE_LANES void store(const Vector& from, float* lanes) {
  std::memcpy(lanes, &from, sizeof(from));
}
/// Integers as floats.
template <class Integer>
BODICE_LANES void load(const Integer* lanes, Vector& to) {
  Integer __attribute__((vector_size(sizeof(Integer) * kLanes))) whole;
  std::memcpy(&whole, lanes, sizeof(whole));
  to = __builtin_convertvector(whole, Vector);
}

/// Four vectors by components as four lanes by components, and back.
BODICE_LANES void transpose(geometry::Float4 (&v)[4]) {
  using geometry::Float4;
  const Float4 a = __builtin_shufflevector(v[0], v[2], 0, 4, 1, 5);
  const Float4 b = __builtin_shufflevector(v[1], v[3], 0, 4, 1, 5);
  const Float4 c = __builtin_shufflevector(v[0], v[2], 2, 6, 3, 7);
  const Float4 d = __builtin_shufflevector(v[1], v[3], 2, 6, 3, 7);
  v[0] = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  v[1] = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  v[2] = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  v[3] = __builtin_shufflevector(c, d, 2, 6, 3, 7);
}

}  // namespace bodice::binding
