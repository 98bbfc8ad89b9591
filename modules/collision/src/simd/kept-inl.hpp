// A batch among the candidates that were kept for it, as long as they hold.
#if defined(BODICE_COLLISION_KEPT_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_KEPT_INL_
#undef BODICE_COLLISION_KEPT_INL_
#else
#define BODICE_COLLISION_KEPT_INL_
#endif

#include <algorithm>
#include <bit>

#include "kept.hpp"
#include "simd/lowest-inl.hpp"
#include "simd/share-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(KeptBatch::kSpan % kStep == 0 && kBlock % KeptBatch::kSpan == 0);

/// Whether no place is farther from where it was than the reach that the proxy's own way leaves.
HWY_INLINE bool holds(const KeptBatch& kept, const QueryBatch& batch) {
  const auto left_m =
      static_cast<float>(double{kept.reach_m} - (batch.keeping.travelled_m - kept.travelled_m));
  if (kept.count < batch.count || !(left_m > 0.0f)) return false;
  const V most = all(left_m * left_m);
  M near = hn::FirstN(f, kWidth);
  for (int i = 0; i < batch.count; i += kWidth) {
    const V3 p = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    const V3 way = p - load3(kept.x + i, kept.y + i, kept.z + i);
    near = hn::And(near, hn::Lt(dot(way, way), most));
  }
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
  std::int32_t sorted[KeptBatch::kMost];
  std::uint32_t moved[KeptBatch::kMost];  // a candidate's bit among the sorted
  for (int i = 0; i < kept.candidates; ++i) {
    int place = 0;
    for (int k = 0; k < kept.candidates; ++k) place += kept.candidate[k] < kept.candidate[i];
    moved[i] = 1u << place;
    sorted[place] = kept.candidate[i];
  }
  for (std::uint32_t& near : kept.near) {
    std::uint32_t after = 0;
    for (std::uint32_t left = near; left != 0; left &= left - 1) after |= moved[std::countr_zero(left)];
    near = after;
  }
  std::copy_n(sorted, kept.candidates, kept.candidate);
}

/// Some vectors of places, every candidate's bound there, and those above which ellipsoids are not kept.
struct Wanted {
  alignas(64) float bound[kMaxCandidates * kStep];  ///< a step a candidate
  V limit[kTogether];
  float least_m;  ///< bound of any
};

template <int kTables>
HWY_INLINE void measure_step(const Baked& baked, const QueryBatch& batch, int from, const Near& near,
                             const Columns& columns, float beyond_m, Wanted& out) {
  V3 p[kTogether];
  Lowest<1> lowest[kTogether];
  for (int v = 0; v < kTogether; ++v) {
    const int i = from + v * kWidth;
    p[v] = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    lowest[v].clear();
  }
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
  for (int v = 0; v < kTogether; ++v) out.limit[v] = bound_limit(baked, feet[v].distance, beyond_m);
  V least = lowest[0].bound[0];
  for (int v = 1; v < kTogether; ++v) least = hn::Min(least, lowest[v].bound[0]);
  out.least_m = hn::GetLane(hn::MinOfLanes(f, least));
}

/// Keeps what may be the nearest of some place of the step, or farther by less than `beyond_m`; false if
/// there is no room. `slot`: where a column's ellipsoid is kept, or -1.
template <int kTables>
HWY_INLINE bool keep_step(const Baked& baked, const QueryBatch& batch, int from, const Near& near,
                          const Columns& columns, float beyond_m, std::int32_t* slot, KeptBatch& kept) {
  Wanted step;
  measure_step<kTables>(baked, batch, from, near, columns, beyond_m, step);
  const int span = from / KeptBatch::kSpan;
  kept.least_m[span] = std::min(kept.least_m[span], step.least_m);
  for (int i = 0; i < near.count; ++i) {
    M below = hn::FirstN(f, 0);
    for (int v = 0; v < kTogether; ++v) {
      const V bound = hn::Load(f, step.bound + i * kStep + v * kWidth);
      below = hn::Or(below, hn::Not(hn::Gt(bound, step.limit[v])));
    }
    if (hn::AllFalse(f, below)) continue;
    const std::int32_t column = near.index[i];
    if (slot[column] < 0) slot[column] = slot_of(kept, static_cast<std::int32_t>(columns.ellipsoid(column)));
    if (slot[column] < 0) return false;
    kept.near[span] |= 1u << slot[column];
  }
  return true;
}

HWY_INLINE void keep_places(const QueryBatch& batch, KeptBatch& kept) {
  for (int i = 0; i < batch.count; i += kWidth) {
    hn::Store(hn::LoadU(f, batch.x + i), f, kept.x + i);
    hn::Store(hn::LoadU(f, batch.y + i), f, kept.y + i);
    hn::Store(hn::LoadU(f, batch.z + i), f, kept.z + i);
  }
  kept.travelled_m = batch.keeping.travelled_m;
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
  std::fill_n(kept.near, KeptBatch::kSpans, 0u);
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
        if (!keep_step<tables()>(baked, batch, from, found[i], columns, widest_m, slot, kept)) return false;
    return true;
  };
  if (!share(baked, relief, blocks.pieces, blocks.count, lists, find, work)) return false;
  // More than two vectors of columns are read by gathers, which cost more than finding anew.
  if (kept.candidates > 2 * kWidth) return false;
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

/// Calls work as share() does, for the spans that may come within `limit_m` of an ellipsoid; others have
/// no candidates.
template <class Work>
HWY_INLINE bool share_kept(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                           float limit_m, Lists& lists, Work&& work) {
  const KeptBatch& kept = *batch.keeping.batch;
  lists.columns.fill(baked, relief, kept.candidate, kept.candidates, false);
  Piece pieces[KeptBatch::kSpans];
  int count = 0;
  for (int begin = 0; begin < batch.count; begin += KeptBatch::kSpan, ++count) {
    pieces[count].begin = begin;
    pieces[count].end = std::min(begin + KeptBatch::kSpan, batch.count);
    Near& near = lists.of_span[count];
    near.count = 0;
    if (kept.least_m[count] - kept.reach_m > limit_m) continue;
    for (std::uint32_t left = kept.near[count]; left != 0; left &= left - 1)
      near.index[near.count++] = std::countr_zero(left);
  }
  bool fits = false;
  with_tables(lists.columns,
              [&](auto tables) { fits = work(tables, lists.columns, pieces, count, lists.of_span); });
  return fits;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
