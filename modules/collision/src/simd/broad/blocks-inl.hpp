// A batch against a proxy of any size: what fits into the kernel's lists together is done together, the rest
// block by block, step by step, or for some ellipsoids at a time.
#if defined(BODICE_COLLISION_SHARE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SHARE_INL_
#undef BODICE_COLLISION_SHARE_INL_
#else
#define BODICE_COLLISION_SHARE_INL_
#endif

#include <algorithm>

#include <hwy/cache_control.h>

#include "model/candidate_cache.hpp"
#include "simd/broad/domination-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kStep = kTogether * kWidth;  // lanes that are worked on together

/// The same lanes of the next batch, a few at a time: asked for all at once, it would hold up what this batch
/// reads. Inlined, since g++ takes a call of what only prefetches for one without effect.
template <int kLanes>
HWY_INLINE void prefetch_step(const Ahead& next, int from, bool contacts) {
  constexpr int kLine = 64 / sizeof(float);
  for (int i = from; next.kept && i < from + kLanes; i += kLine) {
    hwy::Prefetch(next.kept->x + i);
    hwy::Prefetch(next.kept->y + i);
    hwy::Prefetch(next.kept->z + i);
    hwy::Prefetch(next.kept->slack_m[0] + i);
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

/// The places of kCount vectors from lane `from` on.
template <int kCount>
HWY_INLINE void load_step(const QueryBatch& batch, int from, V3 (&p)[kCount]) {
  // To first order the steps store contacts themselves, and would wait for others.
  prefetch_step<kCount * kWidth>(batch.ahead, from,
                                 batch.ahead.contacts && batch.accuracy == Accuracy::kExact);
  for (int v = 0; v < kCount; ++v) {
    const int i = from + v * kWidth;
    p[v] = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
  }
}

/// Of its lanes, in whole steps.
HWY_INLINE int end_of(const Piece& piece) {
  return piece.begin + (piece.end - piece.begin + kStep - 1) / kStep * kStep;
}

/// Those of the lanes from i on that are below the end.
HWY_INLINE M lanes_below(int i, int end) {
  return hn::FirstN(f, static_cast<std::size_t>(std::max(0, end - i)));
}

/// Candidates that all blocks of a batch bound rather than tell which of them may be theirs.
constexpr int kFew = kWidth / 2;

struct Lists {
  Columns columns, alone;
  Near near, of_piece[kBlocks], of_alone, of_span[KeptBatch::kSpans];
  /// Meters around the places of a call within which the next may ask again; share() alone reads it.
  float room_m = 0.0f;
  Extent covered;       ///< the columns hold all candidates of places in it,
  bool covers = false;  ///< if so
};

/// Every column, for a block that does not share them.
HWY_INLINE void choose_all(const Columns& columns, Near& out) {
  out.count = columns.count();
  for (int i = 0; i < out.count; i += kWidth) hn::Store(lanes_from(i), I(), out.index + i);
}

/// All columns for one piece.
template <class Work>
HWY_INLINE bool work_alone(const Piece& piece, const Columns& columns, Near& list, Work&& work) {
  bool fits = false;
  choose_all(columns, list);
  with_tables(columns, [&](auto tables) { fits = work(tables, columns, &piece, 1, &list); });
  return fits;
}

/// Finds the candidates of some pieces at once, and among them those of each: `find` (a source, the box
/// around, pieces, their number, lists out). Then calls `work` (number of tables, columns, pieces, their
/// number, their lists) on all, if their candidates fit into two vectors, or on each. False if either has no
/// room.
template <class Find, class Work>
HWY_INLINE bool share(const Baked& baked, const ReliefTables* relief, const Piece* pieces, int count,
                      Lists& s, Find&& find, Work&& work) {
  Piece around = pieces[0];
  for (int i = 1; i < count; ++i) around.box = united(around.box, pieces[i].box);
  s.covers = false;
  if (s.room_m > 0.0f) around.box = grown(around.box, s.room_m);
  if (!find(Everything(baked), around.box, &around, 1, &s.near)) return false;
  if (s.near.count == 0) return true;
  s.columns.fill(baked, relief, s.near.index, s.near.count);
  s.covered = around.box;
  s.covers = s.room_m > 0.0f && s.near.count <= 2 * kWidth;
  if (count == 1) return work_alone(pieces[0], s.columns, s.of_piece[0], work);
  bool fits = false;
  if (s.near.count <= 2 * kWidth) {
    with_tables(s.columns, [&](auto tables) {
      if (s.near.count <= kFew)
        for (int i = 0; i < count; ++i) choose_all(s.columns, s.of_piece[i]);
      else
        (void)find(AmongColumns<tables()>{s.columns}, around.box, pieces, count, s.of_piece);
      fits = work(tables, s.columns, pieces, count, s.of_piece);
    });
    return fits;
  }
  if (!find(AmongColumns<0>{s.columns}, around.box, pieces, count, s.of_piece)) return false;
  for (int i = 0; i < count; ++i) {
    Near& list = s.of_piece[i];
    if (list.count == 0) continue;
    for (int k = 0; k < list.count; ++k) list.index[k] = s.near.index[list.index[k]];
    s.alone.fill(baked, relief, list.index, list.count);
    if (!work_alone(pieces[i], s.alone, s.of_alone, work)) return false;
  }
  return true;
}

/// The same among the candidates of the call before, if they are those of a box that holds the pieces.
template <class Work>
HWY_INLINE bool share_again(const Piece* pieces, int count, Lists& s, Work&& work) {
  if (!s.covers) return false;
  for (int i = 0; i < count; ++i)
    if (!holds(s.covered, pieces[i].box)) return false;
  Piece all = pieces[0];
  all.end = pieces[count - 1].end;
  return work_alone(all, s.columns, s.of_alone, work);
}

/// One piece and any number of plain ellipsoids, as many at a time as there is room for: `find` (a source,
/// the list out), `work` as above.
template <class Find, class Work>
HWY_INLINE void in_parts(const Baked& baked, const Piece& piece, Lists& s, Find&& find, Work&& work) {
  constexpr int kPart = kMaxCandidates;
  static_assert(kPart % kGroup == 0);
  const int end = static_cast<int>(baked.size());
  for (int k = 0; k < end; k += kPart) {
    find(Everything(baked, k, std::min(k + kPart, end)), &s.near);
    if (s.near.count == 0) continue;
    s.columns.fill(baked, nullptr, s.near.index, s.near.count);
    (void)work_alone(piece, s.columns, s.of_alone, work);
  }
}

HWY_INLINE QueryBatch places(const float* x, const float* y, const float* z, int count) {
  return {.x = x,
          .y = y,
          .z = z,
          .index = nullptr,
          .count = count,
          .margin_m = 0.0f,
          .within_m = kNoLimit,
          .contacts = nullptr,
          .radius_m = {},
          .keeping = {}};
}

/// `near` tells whether all are within kFarthest, which NaN is not.
HWY_INLINE Piece piece_of(const QueryBatch& batch, int begin, int end, bool& near) {
  return {extent_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin, end - begin, near), begin, end};
}

/// The blocks of a batch.
struct Blocks {
  Piece pieces[kBlocks];
  int count = 0;
  bool near = true;  ///< no place is too far for floats

  explicit HWY_INLINE Blocks(const QueryBatch& batch) {
    for (int begin = 0; begin < batch.count; begin += kBlock) {
      bool all_near = false;
      pieces[count++] = piece_of(batch, begin, std::min(begin + kBlock, batch.count), all_near);
      near = near && all_near;
    }
  }
};

/// What fits together is done together: `work` (pieces, their number); what does not, block by block, then
/// step by step; what even then has no room is left to `last` (a piece), which may give up.
template <class Work, class Last>
HWY_INLINE bool together_or_apart(const QueryBatch& batch, const Blocks& blocks, Work&& work, Last&& last) {
  if (work(blocks.pieces, blocks.count)) return true;
  for (int i = 0; i < blocks.count; ++i) {
    if (blocks.count > 1 && work(blocks.pieces + i, 1)) continue;
    for (int begin = blocks.pieces[i].begin; begin < blocks.pieces[i].end; begin += kStep) {
      bool near = false;
      const Piece step = piece_of(batch, begin, std::min(begin + kStep, blocks.pieces[i].end), near);
      if (!work(&step, 1) && !last(step)) return false;
    }
  }
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
