// Runs a kernel on a batch against a proxy of any size. All blocks are done together if their candidates fit
// into the kernel's lists. Otherwise the fallbacks follow: block by block, step by step, or some ellipsoids
// at a time.
#if defined(BODICE_COLLISION_BLOCKS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_BLOCKS_INL_
#undef BODICE_COLLISION_BLOCKS_INL_
#else
#define BODICE_COLLISION_BLOCKS_INL_
#endif

#include <algorithm>

#include <hwy/cache_control.h>

#include "model/candidate_cache.hpp"
#include "simd/broad/domination-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kStep = kVectorsInStep * kWidth;  // lanes that are computed side by side

/// Prefetches the same lanes of the next batch, a few at a time, since all at once would delay this batch's
/// own reads. It is inlined, because g++ drops calls of a function that only prefetches.
template <int kLanes>
HWY_INLINE void prefetch_step(const NextBatch& next, int from, bool contacts) {
  constexpr int kLine = 64 / sizeof(float);
  for (int i = from; next.cached && i < from + kLanes; i += kLine) {
    hwy::Prefetch(next.cached->x + i);
    hwy::Prefetch(next.cached->y + i);
    hwy::Prefetch(next.cached->z + i);
    hwy::Prefetch(next.cached->slack_m[0] + i);
  }
  if (from + kLanes > next.count) return;
  for (int i = from; next.x && i < from + kLanes; i += kLine) {
    hwy::Prefetch(next.x + i);
    hwy::Prefetch(next.y + i);
    hwy::Prefetch(next.z + i);
  }
  if (!contacts) return;
  if (next.index)
    for (int i = from; i < from + kLanes; ++i) __builtin_prefetch(next.contacts + next.index[i], 1);
  else
    for (int i = from; i < from + kLanes; i += 2) __builtin_prefetch(next.contacts + i, 1);
}

/// Loads the positions of kCount vectors, from lane `from` on.
template <int kCount>
HWY_INLINE void load_step(const QueryBatch& batch, int from, V3 (&p)[kCount]) {
  // A first-order query stores contacts in each step, and prefetching more of them would hold up these
  // stores.
  prefetch_step<kCount * kWidth>(batch.next_batch, from,
                                 batch.next_batch.contacts && batch.accuracy == Accuracy::kExact);
  for (int v = 0; v < kCount; ++v) {
    const int i = from + v * kWidth;
    p[v] = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
  }
}

/// End of the range's lanes, rounded up to whole steps.
HWY_INLINE int end_of(const LaneRange& range) {
  return range.begin + (range.end - range.begin + kStep - 1) / kStep * kStep;
}

/// Mask of the lanes i, i + 1, ... that are below the end.
HWY_INLINE M lanes_below(int i, int end) {
  return hn::FirstN(f, static_cast<std::size_t>(std::max(0, end - i)));
}

/// Up to this many shared candidates, each block evaluates all bounds instead of filtering the candidates.
constexpr int kFew = kWidth / 2;

/// Candidates of all ranges and of each, and the columns that hold them.
struct BroadPhaseLists {
  Columns columns, alone;
  CandidateList of_all, of_range[kBlocks], of_alone, of_span[CachedBatch::kSpans];
  /// Distance by which the box of a call is grown, so that the next call may reuse the candidates, meters;
  /// zero: no reuse.
  float room_m = 0.0f;
  Aabb covered;         ///< box in which the columns hold all candidates
  bool covers = false;  ///< whether `covered` is valid
};

/// Lists every column, for a range that does not share them.
HWY_INLINE void list_every_column(const Columns& columns, CandidateList& out) {
  out.count = columns.count();
  for (int i = 0; i < out.count; i += kWidth) hn::Store(lanes_from(i), I(), out.index + i);
}

/// Calls work on one range with all columns as candidates.
template <class Work>
HWY_INLINE bool work_on_range(const LaneRange& range, const Columns& columns, CandidateList& list,
                              Work&& work) {
  bool fits = false;
  list_every_column(columns, list);
  with_tables(columns, [&](auto tables) { fits = work(tables, columns, &range, 1, &list); });
  return fits;
}

/// Finds the candidates of some ranges and calls `work` on them. `find` (source, box around, ranges, their
/// number, lists out) is called for all ranges together, then for each range among the candidates found.
/// `work` (number of tables, columns, ranges, their number, lists) is called once if the candidates fit into
/// two vectors of columns, otherwise once a range. False on overflow in either.
template <class Find, class Work>
HWY_INLINE bool with_candidates(const Baked& baked, const ReliefTables* relief, const LaneRange* ranges,
                                int count, BroadPhaseLists& s, Find&& find, Work&& work) {
  LaneRange around = ranges[0];
  for (int i = 1; i < count; ++i) around.box = united(around.box, ranges[i].box);
  s.covers = false;
  if (s.room_m > 0.0f) around.box = grown(around.box, s.room_m);
  if (!find(AllEllipsoids(baked), around.box, &around, 1, &s.of_all)) return false;
  if (s.of_all.count == 0) return true;
  s.columns.fill(baked, relief, s.of_all.index, s.of_all.count);
  s.covered = around.box;
  s.covers = s.room_m > 0.0f && s.of_all.count <= 2 * kWidth;
  if (count == 1) return work_on_range(ranges[0], s.columns, s.of_range[0], work);
  bool fits = false;
  if (s.of_all.count <= 2 * kWidth) {
    with_tables(s.columns, [&](auto tables) {
      if (s.of_all.count <= kFew)
        for (int i = 0; i < count; ++i) list_every_column(s.columns, s.of_range[i]);
      else
        (void)find(ColumnEllipsoids<tables()>{s.columns}, around.box, ranges, count, s.of_range);
      fits = work(tables, s.columns, ranges, count, s.of_range);
    });
    return fits;
  }
  if (!find(ColumnEllipsoids<0>{s.columns}, around.box, ranges, count, s.of_range)) return false;
  for (int i = 0; i < count; ++i) {
    CandidateList& list = s.of_range[i];
    if (list.count == 0) continue;
    for (int k = 0; k < list.count; ++k) list.index[k] = s.of_all.index[list.index[k]];
    s.alone.fill(baked, relief, list.index, list.count);
    if (!work_on_range(ranges[i], s.alone, s.of_alone, work)) return false;
  }
  return true;
}

/// Calls `work` with the candidates of the previous call if they are known to hold for all ranges.
template <class Work>
HWY_INLINE bool with_previous_candidates(const LaneRange* ranges, int count, BroadPhaseLists& s,
                                         Work&& work) {
  if (!s.covers) return false;
  for (int i = 0; i < count; ++i)
    if (!contains(s.covered, ranges[i].box)) return false;
  LaneRange all = ranges[0];
  all.end = ranges[count - 1].end;
  return work_on_range(all, s.columns, s.of_alone, work);
}

/// One range against any number of plain ellipsoids, as many at a time as there is room for; `find` (source,
/// list out), `work` as above.
template <class Find, class Work>
HWY_INLINE void in_parts(const Baked& baked, const LaneRange& range, BroadPhaseLists& s, Find&& find,
                         Work&& work) {
  constexpr int kPart = kMaxCandidates;
  static_assert(kPart % kGroup == 0);
  const int end = static_cast<int>(baked.size());
  for (int k = 0; k < end; k += kPart) {
    find(AllEllipsoids(baked, k, std::min(k + kPart, end)), &s.of_all);
    if (s.of_all.count == 0) continue;
    s.columns.fill(baked, nullptr, s.of_all.index, s.of_all.count);
    (void)work_on_range(range, s.columns, s.of_alone, work);
  }
}

/// A batch of positions without contacts, cache or limit.
HWY_INLINE QueryBatch batch_at(const float* x, const float* y, const float* z, int count) {
  return {.x = x,
          .y = y,
          .z = z,
          .index = nullptr,
          .count = count,
          .margin_m = 0.0f,
          .within_m = kNoLimit_m,
          .contacts = nullptr,
          .radius_m = {},
          .cache = {}};
}

/// Lanes [begin, end) with their AABB. `in_float_range` is set to whether all are within kFarthest_m, which
/// NaN is not.
HWY_INLINE LaneRange range_of(const QueryBatch& batch, int begin, int end, bool& in_float_range) {
  return {aabb_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin, end - begin, in_float_range),
          begin, end};
}

/// The blocks of a batch.
struct Blocks {
  LaneRange ranges[kBlocks];
  int count = 0;
  bool in_float_range = true;  ///< all particles are within kFarthest_m

  explicit HWY_INLINE Blocks(const QueryBatch& batch) {
    for (int begin = 0; begin < batch.count; begin += kBlock) {
      bool these_in_range = false;
      ranges[count++] = range_of(batch, begin, std::min(begin + kBlock, batch.count), these_in_range);
      in_float_range = in_float_range && these_in_range;
    }
  }
};

/// Calls `work` (ranges, their number) for all blocks together, on overflow for each block, then for each
/// step. What still overflows goes to `last` (a range), which may fail.
template <class Work, class Last>
HWY_INLINE bool with_fallback(const QueryBatch& batch, const Blocks& blocks, Work&& work, Last&& last) {
  if (work(blocks.ranges, blocks.count)) return true;
  for (int i = 0; i < blocks.count; ++i) {
    if (blocks.count > 1 && work(blocks.ranges + i, 1)) continue;
    for (int begin = blocks.ranges[i].begin; begin < blocks.ranges[i].end; begin += kStep) {
      bool in_float_range = false;
      const LaneRange step =
          range_of(batch, begin, std::min(begin + kStep, blocks.ranges[i].end), in_float_range);
      if (!work(&step, 1) && !last(step)) return false;
    }
  }
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
