// Four floats at a time in the compiler's own vector type: SSE on any x86-64, NEON on ARM.
#pragma once

#include <cmath>

#if defined(__SSE__)
#include <immintrin.h>
#endif

namespace bodice::geometry {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

inline Float4 smaller(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 larger(Float4 a, Float4 b) {
  return a < b ? b : a;
}

inline Float4 square_root(Float4 a) {
#if defined(__SSE__)
  return reinterpret_cast<Float4>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#else
  return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

/// Bit i: whether lane i of a comparison holds.
inline unsigned bits(Int4 mask) {
#if defined(__SSE__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return (mask[0] & 1u) | (mask[1] & 2u) | (mask[2] & 4u) | (mask[3] & 8u);
#endif
}

}  // namespace bodice::geometry
