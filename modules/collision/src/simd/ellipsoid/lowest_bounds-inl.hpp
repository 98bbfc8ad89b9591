// The few candidates of a particle that have the lowest bounds.
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
// The rank changes a bound by far less than kEstimate.
static_assert(kMaxCandidates <= 256);

/// A bound that carries its candidate's rank in its low bits.
HWY_INLINE V ranked(V bound, VI rank) {
  return hn::BitCast(f, hn::Or(hn::AndNot(hn::Set(I(), kRankMask), hn::BitCast(I(), bound)), rank));
}

/// The kLowest lowest bounds of each lane, rising, with their candidates' ranks in the low bits. The value
/// after them shows whether they are all that count.
template <int kLowest>
struct LowestBounds {
  V bound[kLowest + 1];

  HWY_INLINE void clear() {
    for (V& b : bound) b = hn::BitCast(f, hn::Set(I(), 0x71490000));  // 1e30 with rank 0
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

/// Bound above which an ellipsoid is certainly farther than `distance` by more than `beyond_m`. A bound may
/// be too high by a fraction of itself, a distance by the rounding.
HWY_INLINE V bound_limit(const Baked& baked, V distance, float beyond_m) {
  const V slack = all(4.0f * baked.rounding_m + beyond_m);
  return hn::Add(hn::MulAdd(all(2.0f * kEstimate), hn::Abs(distance), distance), slack);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
