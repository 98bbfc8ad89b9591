// The few candidates of a particle whose first-order bounds are the lowest.
#if defined(BODICE_COLLISION_LOWEST_BOUNDS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_LOWEST_BOUNDS_INL_
#undef BODICE_COLLISION_LOWEST_BOUNDS_INL_
#else
#define BODICE_COLLISION_LOWEST_BOUNDS_INL_
#endif

#include "model/batch.hpp"
#include "simd/ellipsoid/bound-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr std::int32_t kRankMask = kMaxCandidates - 1;
static_assert((kMaxCandidates & kRankMask) == 0, "a rank must fit into the low bits of a bound");
// What the rank in its low bits can change a bound by is far below kEstimate.
static_assert(kMaxCandidates <= 256);

/// A bound with its candidate's rank in the low bits.
HWY_INLINE V ranked(V bound, VI rank) {
  return hn::BitCast(f, hn::Or(hn::AndNot(hn::Set(I(), kRankMask), hn::BitCast(I(), bound)), rank));
}

/// The lowest bounds of a vector of particles, rising, each with its candidate's rank in the low bits; of the
/// last only the value matters: it tells whether those that are kept are all that count.
template <int kLowest>
struct LowestBounds {
  V bound[kLowest + 1];

  HWY_INLINE void clear() {
    for (V& b : bound) b = hn::BitCast(f, hn::Set(I(), 0x71490000));  // 1e30, of rank 0
  }
  HWY_INLINE void add(V value, VI rank) {
    V next = ranked(value, rank);
    for (int i = 0; i < kLowest; ++i) {
      const V higher = hn::Max(bound[i], next);
      bound[i] = hn::Min(bound[i], next);
      next = higher;
    }
    bound[kLowest] = hn::Min(bound[kLowest], next);
  }
  HWY_INLINE VI rank(int i) const { return hn::And(hn::BitCast(I(), bound[i]), hn::Set(I(), kRankMask)); }
};

/// The bound above which an ellipsoid is farther than `distance` by more than `beyond_m`: a bound is too high
/// by a share of itself, a distance by the rounding.
HWY_INLINE V bound_limit(const Baked& baked, V distance, float beyond_m) {
  const V slack = all(4.0f * baked.rounding_m + beyond_m);
  return hn::Add(hn::MulAdd(all(2.0f * kEstimate), hn::Abs(distance), distance), slack);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
