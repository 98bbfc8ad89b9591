// The broad phase of a query with a contact distance.
#if defined(BODICE_COLLISION_LIMITS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_LIMITS_INL_
#undef BODICE_COLLISION_LIMITS_INL_
#else
#define BODICE_COLLISION_LIMITS_INL_
#endif

#include "simd/broad/blocks-inl.hpp"
#include "simd/ellipsoid/lowest_bounds-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The contact distance as a limit on corrected distances, and as a limit on distances to plain ellipsoids.
struct QueryLimits {
  float surface_m, plain_m;

  HWY_INLINE QueryLimits(const Baked& baked, const ReliefTables* relief, float limit_m)
      : surface_m(limit_m + 4.0f * baked.rounding_m), plain_m(surface_m) {
    if (!relief) return;
    plain_m = relief->farthest.at_zero_m[0] + relief->farthest.shift_m(surface_m);
  }
  /// The limit on bounds.
  HWY_INLINE float of_bounds(const Baked& baked) const {
    return hn::GetLane(bound_limit(baked, all(plain_m), 0.0f));
  }
};

/// with_candidates() among the ellipsoids that may come within the limits. False also if a particle is too
/// far away for floats.
template <class Work>
HWY_INLINE bool with_limited_candidates(const Baked& baked, const ReliefTables* relief, QueryBatch& batch,
                                        float beyond_m, const QueryLimits& limits, BroadPhaseLists& lists,
                                        Work&& work) {
  const Blocks blocks(batch);
  if (!blocks.in_float_range) return false;
  for (int i = 0; i < blocks.count; ++i) batch.radius_m[i] = blocks.ranges[i].box.radius;
  // A limit that is small beside the blocks leaves about as few candidates as domination, which costs a dozen
  // closest points a block.
  const bool close = limits.plain_m <= blocks.ranges[0].box.radius;
  const auto find = [&](const auto& source, const Aabb& around, const LaneRange* ranges, int count,
                        CandidateList* found) {
    const float below_m = limits.plain_m + beyond_m;
    if (close) return find_candidates_below(source, around, ranges, count, below_m, found);
    return find_candidates<true>(source, around, ranges, count, beyond_m, below_m, found);
  };
  return with_candidates(baked, relief, blocks.ranges, blocks.count, lists, find, work);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
