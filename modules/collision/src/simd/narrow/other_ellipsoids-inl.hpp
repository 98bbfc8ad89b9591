// Finds which positions, already pushed clear of one to three ellipsoids, are below the clearance of another.
// Along its normal a convex shape keeps its closest point, and a half-space beyond a tangent plane contains
// no point of the shape. The cleared ellipsoids therefore need no evaluation, and bounds exclude most of the
// others.
#if defined(BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_
#undef BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_
#else
#define BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_
#endif

#include "simd/narrow/nearest-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// Positions and the ellipsoids that they were pushed clear of: internal indices, or negative.
struct ClearedPositions {
  const QueryBatch& batch;
  const std::int32_t *first, *second, *third;
};

/// The lowest bound at each position among the ellipsoids that were not cleared.
HWY_INLINE void bound_others(const Baked& baked, const Columns& columns, const CandidateList& candidates,
                             const ClearedPositions& cleared, int from,
                             LowestBounds<1> (&out)[kVectorsInStep]) {
  V3 p[kVectorsInStep];
  VI first[kVectorsInStep], second[kVectorsInStep], third[kVectorsInStep];
  for (int v = 0; v < kVectorsInStep; ++v) {
    const int i = from + v * kWidth;
    p[v] = load3(cleared.batch.x + i, cleared.batch.y + i, cleared.batch.z + i);
    first[v] = hn::Load(I(), cleared.first + i);
    second[v] = hn::Load(I(), cleared.second + i);
    third[v] = hn::Load(I(), cleared.third + i);
    out[v].clear();
  }
  for (int r = 0; r < candidates.count; ++r) {
    const std::size_t k = columns.ellipsoid(candidates.index[r]);
    const VI rank = hn::Set(I(), candidates.index[r]), which = hn::Set(I(), static_cast<std::int32_t>(k));
    for (int v = 0; v < kVectorsInStep; ++v) {
      const auto own =
          hn::Or(hn::Eq(first[v], which), hn::Or(hn::Eq(second[v], which), hn::Eq(third[v], which)));
      const V bound = lower_bound(baked.bounds[k], p[v]);
      out[v].add(hn::IfThenElse(hn::RebindMask(f, own), all(1e29f), bound), rank);
    }
  }
}

/// Evaluates the other ellipsoids of some ranges, with the columns as candidates.
template <int kTables>
HWY_INLINE bool evaluate_others(const Baked& baked, const ClearedPositions& cleared, float limit_m,
                                const LaneRange* ranges, int count, const CandidateList* candidates,
                                const Columns& columns, Open& open, BatchResults& out) {
  const QueryBatch& batch = cleared.batch;
  open.pairs.count = open.count = 0;
  const V limit = bound_limit(baked, all(limit_m), 0.0f);
  for (int range = 0; range < count; ++range)
    for (int from = ranges[range].begin; from < end_of(ranges[range]); from += kStep) {
      LowestBounds<1> lowest[kVectorsInStep];
      bound_others(baked, columns, candidates[range], cleared, from, lowest);
      (void)make_room<kTables>(kVectorsInStep, nullptr, columns, batch, open.pairs, out);
      for (int v = 0; v < kVectorsInStep; ++v) {
        const int i = from + v * kWidth;
        open.add<1, 0>(lanes_below(i, ranges[range].end), lowest[v], limit, lanes_from(i));
      }
    }
  (void)collect_rest<kTables>(baked, nullptr, columns, batch, open, out);
  flush<kTables>(nullptr, columns, batch, open.pairs, out);
  return true;
}

/// The nearest of the other ellipsoids at each position, exact where it is nearer than the limit, elsewhere
/// some distance beyond it. False if a position is too far away for floats.
inline bool nearest_others(const Baked& baked, const ClearedPositions& cleared, float limit_m,
                           Scratch& scratch, BatchResults& out) {
  const QueryBatch& batch = cleared.batch;
  const Blocks blocks(batch);
  if (!blocks.in_float_range) return false;
  for (int i = 0; i < batch.count; i += kWidth) {
    hn::Store(all(1e30f), f, out.distance + i);
    hn::Store(hn::Zero(I()), I(), out.proxy_index + i);
  }
  const float below_m = limit_m + 4.0f * baked.rounding_m;
  const auto find = [&](const auto& source, const Aabb& around, const LaneRange* ranges, int count,
                        CandidateList* lists) {
    return find_candidates_below(source, around, ranges, count, below_m, lists);
  };
  const auto work = [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
                        const CandidateList* lists) {
    return evaluate_others<tables()>(baked, cleared, limit_m, ranges, count, lists, columns, scratch.open,
                                     out);
  };
  return with_fallback(
      batch, blocks,
      [&](const LaneRange* ranges, int count) {
        return with_candidates(baked, nullptr, ranges, count, scratch.lists, find, work);
      },
      [&](const LaneRange& range) {
        in_parts(
            baked, range, scratch.lists,
            [&](const AllEllipsoids& source, CandidateList* list) {
              (void)find_candidates_below(source, range.box, &range, 1, below_m, list);
            },
            work);
        return true;
      });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
