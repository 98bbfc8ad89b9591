// The proxy's distance at every particle of a batch, exactly. A first-order bound of the distance to every
// candidate of a block finds the probable owner; its exact foot then leaves, at most particles, no other
// candidate whose bound is below. What is left (of plain ellipsoids one in five particles, of blended ones
// three in four) is collected from the whole block, so that it fills vectors again.
#if defined(BODICE_COLLISION_NEAREST_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NEAREST_INL_
#undef BODICE_COLLISION_NEAREST_INL_
#else
#define BODICE_COLLISION_NEAREST_INL_
#endif

#include <algorithm>
#include <limits>

#include "simd/combine-inl.hpp"
#include "simd/lowest-inl.hpp"
#include "simd/near-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(kBlock % (kTogether * kWidth) == 0);

/// The bounds of a block's candidates at some vectors of particles.
template <int kKept>
HWY_INLINE void bound_vectors(const Baked& baked, const Columns& columns, const Near& near,
                              const V3 (&p)[kTogether], Lowest<kKept> (&out)[kTogether]) {
  for (Lowest<kKept>& lowest : out) lowest.clear();
  for (int i = 0; i < near.count; ++i) {
    const BoundEllipsoid& e = baked.bounds[columns.ellipsoid(near.index[i])];
    const VI rank = hn::Set(I(), near.index[i]);
    for (int v = 0; v < kTogether; ++v) out[v].add(lower_bound(e, p[v]), rank);
  }
}

/// What the first answers leave open.
struct Open {
  Pairs pairs;
  /// Particles with more candidates below the limit than were kept: their lanes, the highest bound that was
  /// kept and the limit, by number.
  alignas(64) std::int32_t lane[kBatch + 16];
  alignas(64) float kept[kBatch + 16], limit[kBatch + 16];
  int count = 0;

  /// Candidates kFirst and following of those kept.
  template <int kKept, int kFirst>
  HWY_INLINE void add(const Lowest<kKept>& lowest, V limits, VI lanes) {
    for (int i = kFirst; i < kKept; ++i)
      pairs.add(hn::Not(hn::Gt(lowest.bound[i], limits)), lanes, lowest.rank(i));
    const M many = hn::Not(hn::Gt(lowest.bound[kKept], limits));
    hn::StoreU(hn::Compress(lanes, hn::RebindMask(I(), many)), I(), lane + count);
    hn::StoreU(hn::Compress(lowest.bound[kKept - 1], many), f, kept + count);
    hn::StoreU(hn::Compress(limits, many), f, limit + count);
    count += static_cast<int>(hn::CountTrue(f, many));
  }
};

/// What was collected: answered, and of plain ellipsoids taken over.
template <int kTables>
void flush(const ReliefTables* relief, const Columns& columns, const QueryBatch& batch, Pairs& pairs,
           Batched& out) {
  answer_pairs<kTables>(relief, columns, batch, pairs);
  if (relief) return;
  combine_nearest(pairs, out);
  pairs.count = 0;
}

/// Room for pairs of so many vectors; false if there is none, as blended answers must be kept together.
template <int kTables>
HWY_INLINE bool make_room(int vectors, const ReliefTables* relief, const Columns& columns,
                          const QueryBatch& batch, Pairs& pairs, Batched& out) {
  if (pairs.fit(vectors)) return true;
  if (relief) return false;
  flush<kTables>(nullptr, columns, batch, pairs, out);
  return true;
}

/// The pairs of the particles with many; false if they do not fit.
template <int kTables>
HWY_INLINE bool collect_rest(const Baked& baked, const ReliefTables* relief, const Columns& columns,
                             const QueryBatch& batch, Open& open, Batched& out) {
  for (int from = 0; from < open.count; from += kWidth) {
    const M valid = hn::FirstN(f, static_cast<std::size_t>(open.count - from));
    const VI lanes = hn::IfThenElseZero(hn::RebindMask(I(), valid), hn::Load(I(), open.lane + from));
    const V3 p = {hn::GatherIndex(f, batch.x, lanes), hn::GatherIndex(f, batch.y, lanes),
                  hn::GatherIndex(f, batch.z, lanes)};
    const V kept = hn::Load(f, open.kept + from), limit = hn::Load(f, open.limit + from);
    for (int i = 0; i < columns.count(); ++i) {
      if (!make_room<kTables>(1, relief, columns, batch, open.pairs, out)) return false;
      const VI rank = hn::Set(I(), i);
      const V bound = ranked(lower_bound(baked.bounds[columns.ellipsoid(i)], p), rank);
      open.pairs.add(hn::And(valid, hn::AndNot(hn::Gt(bound, limit), hn::Gt(bound, kept))), lanes, rank);
    }
  }
  return true;
}

constexpr int kStep = kTogether * kWidth;  // lanes that are worked on together

/// Of its lanes, in whole steps.
HWY_INLINE int end_of(const Piece& piece) {
  return piece.begin + (piece.end - piece.begin + kStep - 1) / kStep * kStep;
}

/// The first answers of one piece; false if there is no room for what they leave open.
template <int kKept, int kTables>
HWY_INLINE bool answer_first(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                             const Piece& piece, const Near& near, const Columns& columns, Open& open,
                             Batched& out) {
  const float beyond_m = relief ? relief->blend_m : 0.0f;
  for (int from = piece.begin; from < end_of(piece); from += kStep) {
    V3 p[kTogether];
    Lowest<kKept> lowest[kTogether];
    VI first[kTogether];
    Answer answers[kTogether];
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      p[v] = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    }
    bound_vectors(baked, columns, near, p, lowest);
    for (int v = 0; v < kTogether; ++v) first[v] = lowest[v].rank(0);
    answer_each<kTables>(relief, columns, first, p, answers);
    if (!make_room<kTables>((kKept - 1) * kTogether, relief, columns, batch, open.pairs, out)) return false;
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      put(answers[v], relief != nullptr, out, i);
      open.add<kKept, 1>(lowest[v], bound_limit(baked, answers[v].distance, beyond_m), hn::Iota(I(), i));
    }
  }
  return true;
}

/// Some pieces of the batch whose candidates are the columns.
template <int kKept, int kTables>
HWY_INLINE bool nearest_of(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                           const Piece* pieces, int count, const Near* near, const Columns& columns,
                           Open& open, Batched& out) {
  open.pairs.count = open.count = 0;
  for (int i = 0; i < count; ++i)
    if (!answer_first<kKept, kTables>(baked, relief, batch, pieces[i], near[i], columns, open, out))
      return false;
  if (!collect_rest<kTables>(baked, relief, columns, batch, open, out)) return false;
  flush<kTables>(relief, columns, batch, open.pairs, out);
  if (relief) combine_blended(*relief, pieces[0].begin, end_of(pieces[count - 1]), open.pairs, out);
  return true;
}

/// Every column, for a block that does not share them.
HWY_INLINE void choose_all(const Columns& columns, Near& out) {
  out.count = columns.count();
  for (int i = 0; i < out.count; i += kWidth) hn::Store(hn::Iota(I(), i), I(), out.index + i);
}

struct Scratch {
  Columns columns, alone;
  Open open;
  Near near, of_piece[kBlocks], of_alone;
};

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
                      Scratch& s, Find&& find, Work&& work) {
  Piece around = pieces[0];
  for (int i = 1; i < count; ++i) around.box = united(around.box, pieces[i].box);
  if (!find(Everything(baked), around.box, &around, 1, &s.near)) return false;
  if (s.near.count == 0) return true;
  s.columns.fill(baked, relief, s.near.index, s.near.count);
  if (count == 1) return work_alone(pieces[0], s.columns, s.of_piece[0], work);
  bool fits = false;
  if (s.near.count <= 2 * kWidth) {
    with_tables(s.columns, [&](auto tables) {
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

/// One piece and any number of plain ellipsoids, as many at a time as there is room for: `find` (a source,
/// the list out), `work` as above.
template <class Find, class Work>
HWY_INLINE void in_parts(const Baked& baked, const Piece& piece, Scratch& s, Find&& find, Work&& work) {
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

/// The nearer of two answers about the lanes of a piece; of equals, that of the lowest index.
HWY_INLINE void take_nearer(const Piece& piece, const Batched& other, Batched& out) {
  for (int i = piece.begin; i < piece.end; ++i) {
    if (other.distance[i] > out.distance[i]) continue;
    if (other.distance[i] == out.distance[i] && other.name[i] > out.name[i]) continue;
    out.distance[i] = other.distance[i];
    out.gx[i] = other.gx[i];
    out.gy[i] = other.gy[i];
    out.gz[i] = other.gz[i];
    out.name[i] = other.name[i];
  }
}

/// Plain ellipsoids, however many are near the piece.
template <class Work>
HWY_INLINE void nearest_in_parts(const Baked& baked, const Piece& piece, float beyond_m, Scratch& scratch,
                                 Work&& work, Batched& out) {
  Rivals rivals;
  find_rivals(Everything(baked), piece.box, &piece, 1, &rivals);
  measure_corners(Everything(baked), &piece, 1, &rivals);
  Batched part;
  std::fill(out.distance + piece.begin, out.distance + piece.end, std::numeric_limits<float>::infinity());
  const auto find = [&](const Everything& source, Near* list) {
    (void)collect_unbeaten(source, piece.box, &piece, 1, &rivals, beyond_m, list);
  };
  in_parts(baked, piece, scratch, find,
           [&](auto tables, const Columns& columns, const Piece* pieces, int count, const Near* lists) {
             (void)work(tables, columns, pieces, count, lists, part);
             take_nearer(piece, part, out);
             return true;
           });
}

/// Distance, unit gradient and owner of every particle; false if a place is too far for floats, or more
/// ellipsoids with relief are near than the kernel has room for.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Scratch& scratch,
                    Batched& out) {
  const Blocks blocks(batch);
  if (!blocks.near) return false;
  for (int i = 0; i < blocks.count; ++i) batch.radius_m[i] = blocks.pieces[i].box.radius;
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  const auto find = [&](const auto& source, const Extent& around, const Piece* pieces, int count,
                        Near* lists) { return find_near(source, around, pieces, count, beyond_m, lists); };
  const auto answer = [&](auto tables, const Columns& columns, const Piece* pieces, int count,
                          const Near* lists, Batched& to) {
    Open& open = scratch.open;
    if (relief) return nearest_of<3, tables()>(baked, relief, batch, pieces, count, lists, columns, open, to);
    return nearest_of<2, tables()>(baked, nullptr, batch, pieces, count, lists, columns, open, to);
  };
  const auto work = [&](auto tables, const Columns& columns, const Piece* pieces, int count,
                        const Near* lists) { return answer(tables, columns, pieces, count, lists, out); };
  return together_or_apart(
      batch, blocks,
      [&](const Piece* pieces, int count) {
        return share(baked, relief, pieces, count, scratch, find, work);
      },
      [&](const Piece& piece) {
        if (relief) return false;
        nearest_in_parts(baked, piece, beyond_m, scratch, answer, out);
        return true;
      });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
