// A batch among the candidates that were kept for it, as long as they hold.
#if defined(BODICE_COLLISION_KEPT_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_KEPT_INL_
#undef BODICE_COLLISION_KEPT_INL_
#else
#define BODICE_COLLISION_KEPT_INL_
#endif

#include <algorithm>
#include <cmath>

#include "model/candidate_cache.hpp"
#include "simd/broad/blocks-inl.hpp"
#include "simd/ellipsoid/lowest_bounds-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(KeptBatch::kSpan % kStep == 0 && kBlock % KeptBatch::kSpan == 0);

/// Whether no place is farther from where it was than the reach that the proxy's own way leaves; takes note
/// of the farthest.
HWY_INLINE bool holds(KeptBatch& kept, const QueryBatch& batch) {
  const auto traveled_m = static_cast<float>(batch.keeping.traveled_m - kept.traveled_m);
  const float left_m = kept.reach_m - traveled_m;
  if (kept.count < batch.count || !(left_m > 0.0f)) return false;
  const V limit = all(left_m * left_m);
  V most = hn::Zero(f);
  M near = hn::FirstN(f, kWidth);
  for (int i = 0; i < batch.count; i += kWidth) {
    const V3 p = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    const V3 way = p - load3(kept.x + i, kept.y + i, kept.z + i);
    const V way2 = dot(way, way);
    near = hn::And(near, hn::Lt(way2, limit));
    most = hn::Max(most, way2);
  }
  kept.moved_m = traveled_m + 1.001f * std::sqrt(hn::GetLane(hn::MaxOfLanes(f, most)));
  return hn::AllTrue(f, near);
}

/// Where the ellipsoid is kept, which may be new; -1 if there is no room.
HWY_INLINE int slot_of(KeptBatch& kept, std::int32_t ellipsoid) {
  for (int i = 0; i < kept.candidates; ++i)
    if (kept.candidate[i] == ellipsoid) return i;
  if (kept.candidates == KeptBatch::kMost) return -1;
  kept.candidate[kept.candidates] = ellipsoid;
  return kept.candidates++;
}

/// By rising index, as all lists are: blended answers are summed in that order.
HWY_INLINE void sort_candidates(KeptBatch& kept) {
  std::int32_t sorted[KeptBatch::kMost], from[KeptBatch::kMost];
  for (int i = 0; i < kept.candidates; ++i) {
    int place = 0;
    for (int k = 0; k < kept.candidates; ++k) place += kept.candidate[k] < kept.candidate[i];
    sorted[place] = kept.candidate[i];
    from[place] = i;
  }
  for (float(&slack_m)[KeptBatch::kMost] : kept.slack_m) {
    float before_m[KeptBatch::kMost];
    std::copy_n(slack_m, KeptBatch::kMost, before_m);
    for (int i = 0; i < kept.candidates; ++i) slack_m[i] = before_m[from[i]];
  }
  std::copy_n(sorted, kept.candidates, kept.candidate);
}

/// Some vectors of places, every candidate's bound there, and those above which ellipsoids are farther than
/// the nearest.
struct Wanted {
  alignas(64) float bound[kMaxCandidates * kStep];  ///< a step a candidate
  V limit[kTogether];
  float least_m;  ///< bound of any
};

template <int kTables>
HWY_INLINE void measure_step(const Baked& baked, const QueryBatch& batch, int from, const Near& near,
                             const Columns& columns, Wanted& out) {
  V3 p[kTogether];
  Lowest<0> lowest[kTogether];
  load_step(batch, from, p);
  for (Lowest<0>& l : lowest) l.clear();
  for (int i = 0; i < near.count; ++i)
    for (int v = 0; v < kTogether; ++v) {
      const V bound = lower_bound(baked.bounds[columns.ellipsoid(near.index[i])], p[v]);
      hn::Store(bound, f, out.bound + i * kStep + v * kWidth);
      lowest[v].add(bound, hn::Set(I(), near.index[i]));
    }
  Shape shapes[kTogether];
  Foot feet[kTogether];
  for (int v = 0; v < kTogether; ++v) shapes[v] = shape_of<kTables>(columns, lowest[v].rank(0));
  feet_of(shapes, p, feet);
  for (int v = 0; v < kTogether; ++v) out.limit[v] = bound_limit(baked, feet[v].distance, 0.0f);
  V least = lowest[0].bound[0];
  for (int v = 1; v < kTogether; ++v) least = hn::Min(least, lowest[v].bound[0]);
  out.least_m = hn::GetLane(hn::MinOfLanes(f, least));
}

/// Keeps what is farther than the nearest of some place of the step by less than `beyond_m` and twice the
/// reach; false if there is no room. `slot`: where a column's ellipsoid is kept, or -1.
template <int kTables>
HWY_INLINE bool keep_step(const Baked& baked, const QueryBatch& batch, int from, const Near& near,
                          const Columns& columns, float beyond_m, std::int32_t* slot, KeptBatch& kept) {
  Wanted step;
  measure_step<kTables>(baked, batch, from, near, columns, step);
  const int span = from / KeptBatch::kSpan;
  kept.least_m[span] = std::min(kept.least_m[span], step.least_m);
  const float widest_m = beyond_m + 2.0f * kept.reach_m;
  for (int i = 0; i < near.count; ++i) {
    V slack = all(KeptBatch::kFar);
    for (int v = 0; v < kTogether; ++v) {
      const V bound = hn::Load(f, step.bound + i * kStep + v * kWidth);
      slack = hn::Min(slack, hn::Max(hn::Sub(bound, step.limit[v]), hn::Zero(f)));
    }
    if (hn::AllTrue(f, hn::Gt(slack, all(widest_m)))) continue;
    const float slack_m = hn::GetLane(hn::MinOfLanes(f, slack));
    const std::int32_t column = near.index[i];
    if (slot[column] < 0) slot[column] = slot_of(kept, static_cast<std::int32_t>(columns.ellipsoid(column)));
    if (slot[column] < 0) return false;
    float& least_m = kept.slack_m[span][slot[column]];
    least_m = std::min(least_m, slack_m);
  }
  return true;
}

HWY_INLINE void keep_places(const QueryBatch& batch, KeptBatch& kept) {
  for (int i = 0; i < batch.count; i += kWidth) {
    hn::Store(hn::LoadU(f, batch.x + i), f, kept.x + i);
    hn::Store(hn::LoadU(f, batch.y + i), f, kept.y + i);
    hn::Store(hn::LoadU(f, batch.z + i), f, kept.z + i);
  }
  kept.traveled_m = batch.keeping.traveled_m;
  kept.moved_m = 0.0f;
  kept.count = batch.count;
}

/// Finds what is to be kept; false if it does not fit, or places are too far for floats.
inline bool keep(const Baked& baked, const ReliefTables* relief, float beyond_m, QueryBatch& batch,
                 Lists& lists) {
  KeptBatch& kept = *batch.keeping.batch;
  const Blocks blocks(batch);
  if (!blocks.near) return false;
  for (int i = 0; i < blocks.count; ++i) batch.radius_m[i] = blocks.pieces[i].box.radius;
  const float widest_m = beyond_m + 2.0f * kept.reach_m;
  kept.candidates = 0;
  std::fill_n(kept.slack_m[0], KeptBatch::kSpans * KeptBatch::kMost, KeptBatch::kFar);
  std::fill_n(kept.least_m, KeptBatch::kSpans, kNoLimit);
  const auto find = [&](const auto& source, const Extent& around, const Piece* pieces, int count,
                        Near* found) {
    return find_near<false>(source, around, pieces, count, widest_m, kNoLimit, found);
  };
  const auto work = [&](auto tables, const Columns& columns, const Piece* pieces, int count,
                        const Near* found) {
    std::int32_t slot[kMaxCandidates];
    std::fill_n(slot, columns.count(), -1);
    for (int i = 0; i < count; ++i)
      for (int from = pieces[i].begin; from < end_of(pieces[i]); from += kStep)
        if (!keep_step<tables()>(baked, batch, from, found[i], columns, beyond_m, slot, kept)) return false;
    return true;
  };
  if (!share(baked, relief, blocks.pieces, blocks.count, lists, find, work)) return false;
  // Gathers cost more than finding anew.
  if (kept.candidates > kPermuted) return false;
  sort_candidates(kept);
  keep_places(batch, kept);
  return true;
}

/// Whether the batch's candidates are kept, be it from now on.
HWY_INLINE bool is_kept(const Baked& baked, const ReliefTables* relief, float beyond_m, QueryBatch& batch,
                        Lists& lists) {
  const Keeping& keeping = batch.keeping;
  if (!keeping.batch) return false;
  KeptBatch& kept = *keeping.batch;
  if (holds(kept, batch)) {
    ++kept.used;
    std::fill_n(batch.radius_m, kBlocks, -1.0f);
    return true;
  }
  if (!kept.renew(keeping.least_reach_m, keeping.most_reach_m)) return false;
  if (keep(baked, relief, beyond_m, batch, lists)) return true;
  kept.give_up();
  return false;
}

/// The candidates of a span that may be the nearest by now, or farther than it by `beyond_m`.
HWY_INLINE void list_span(const KeptBatch& kept, int span, float beyond_m, Near& out) {
  const V most = all(beyond_m + 2.0f * kept.moved_m);
  out.count = 0;
  for (int first = 0; first < kept.candidates; first += kWidth) {
    const Pack near(hn::Le(hn::Load(f, kept.slack_m[span] + first), most));
    near.store(lanes_from(first), out.index + out.count);
    out.count += near.count();
  }
}

/// Calls work as share() does, for the spans that may come within `limit_m` of an ellipsoid; others have
/// no candidates.
template <class Work>
HWY_INLINE bool share_kept(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                           float beyond_m, float limit_m, Columns::Rows rows, Lists& lists, Work&& work) {
  const KeptBatch& kept = *batch.keeping.batch;
  lists.columns.fill(baked, relief, kept.candidate, kept.candidates, rows);
  Piece pieces[KeptBatch::kSpans];
  int count = 0;
  for (int begin = 0; begin < batch.count; begin += KeptBatch::kSpan, ++count) {
    pieces[count].begin = begin;
    pieces[count].end = std::min(begin + KeptBatch::kSpan, batch.count);
    lists.of_span[count].count = 0;
    if (kept.least_m[count] - kept.moved_m <= limit_m) list_span(kept, count, beyond_m, lists.of_span[count]);
  }
  bool fits = false;
  with_tables(lists.columns,
              [&](auto tables) { fits = work(tables, lists.columns, pieces, count, lists.of_span); });
  return fits;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
