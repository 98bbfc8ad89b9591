// Four floats at a time in the compiler's own vector type. It is SSE on any x86-64 and NEON on ARM, so that
// nothing is dispatched at run time.
#pragma once

#include <cmath>

#if defined(__SSE2__)
#include <immintrin.h>

#include <bodice/engine/version.hpp>
#endif

namespace bodice::inline v0_1::geometry {

/// A vector of four floats, one a lane.
using Float4 = float __attribute__((vector_size(16)));
/// A vector of four integers. As the result of a comparison, a lane is -1 where it holds and 0 elsewhere.
using Int4 = int __attribute__((vector_size(16)));

/// The smaller value of each lane; b where the two are equal or one is NaN.
inline Float4 min(Float4 a, Float4 b) {
  return a < b ? a : b;
}
/// The larger value of each lane; b where the two are equal or one is NaN.
inline Float4 max(Float4 a, Float4 b) {
  return a > b ? a : b;
}

/// The square root of each lane. A loop over std::sqrt would set errno, and so take one lane at a time.
inline Float4 square_root(Float4 a) {
#if defined(__SSE2__)
  return reinterpret_cast<Float4>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#else
  return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

/// Bit i is set where lane i of a comparison holds.
inline unsigned lane_bits(Int4 holds) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(holds)));
#else
  return (holds[0] & 1u) | (holds[1] & 2u) | (holds[2] & 4u) | (holds[3] & 8u);
#endif
}

/// Whether any lane of a comparison holds.
inline bool any(Int4 holds) {
  return lane_bits(holds) != 0;
}

}  // namespace bodice::geometry
