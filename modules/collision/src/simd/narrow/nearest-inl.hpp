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

#include "simd/broad/cached_candidates-inl.hpp"
#include "simd/narrow/combine-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(kBlock % (kTogether * kWidth) == 0);

/// The bounds of a block's candidates at some vectors of particles.
template <int kKept>
HWY_INLINE void bound_vectors(const Baked& baked, const Columns& columns, const Near& near,
                              const V3 (&p)[kTogether], Lowest<kKept> (&out)[kTogether]) {
  for (Lowest<kKept>& lowest : out) lowest.clear();
  for (int i = 0; i < near.count; ++i) {
    const BallMap& e = baked.bounds[columns.ellipsoid(near.index[i])];
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

  /// Candidates kFirst and following of those kept, of the lanes `of`.
  template <int kKept, int kFirst>
  HWY_INLINE void add(M of, const Lowest<kKept>& lowest, V limits, VI lanes) {
    for (int i = kFirst; i < kKept; ++i)
      pairs.add(hn::AndNot(hn::Gt(lowest.bound[i], limits), of), lanes, lowest.rank(i));
    const M many = hn::AndNot(hn::Gt(lowest.bound[kKept], limits), of);
    const Pack pack(many);
    pack.store(lanes, lane + count);
    pack.store(lowest.bound[kKept - 1], kept + count);
    pack.store(limits, limit + count);
    count += pack.count();
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

constexpr int kNext = 4;

/// Some particles with more candidates below their limits than were kept.
struct Crowded {
  M lanes;
  VI lane;
  V3 p;
  V kept, limit;
};

/// All the others of their candidates.
template <int kTables>
HWY_INLINE void collect_all(const Baked& baked, const Columns& columns, const QueryBatch& batch,
                            const Crowded& who, Pairs& pairs, Batched& out) {
  for (int i = 0; i < columns.count(); ++i) {
    (void)make_room<kTables>(1, nullptr, columns, batch, pairs, out);
    const VI rank = hn::Set(I(), i);
    const V bound = ranked(lower_bound(baked.bounds[columns.ellipsoid(i)], who.p), rank);
    const M open = hn::AndNot(hn::Gt(bound, who.limit), hn::Gt(bound, who.kept));
    pairs.add(hn::And(who.lanes, open), who.lane, rank);
  }
}

/// The same by rising bounds: blended answers are summed in an order that other candidates must not change.
/// False if they do not fit.
template <int kTables>
HWY_INLINE bool collect_rising(const Baked& baked, const ReliefTables& relief, const Columns& columns,
                               const QueryBatch& batch, Crowded& who, Pairs& pairs, Batched& out) {
  M& more = who.lanes;
  for (int taken = 0; taken < columns.count() && !hn::AllFalse(f, more); taken += kNext) {
    Lowest<kNext> next;
    next.clear();
    for (int i = 0; i < columns.count(); ++i) {
      const VI rank = hn::Set(I(), i);
      const V bound = ranked(lower_bound(baked.bounds[columns.ellipsoid(i)], who.p), rank);
      next.add(hn::IfThenElse(hn::Gt(bound, who.kept), bound, all(1e29f)), rank);
    }
    if (!make_room<kTables>(kNext, &relief, columns, batch, pairs, out)) return false;
    for (int i = 0; i < kNext; ++i)
      pairs.add(hn::AndNot(hn::Gt(next.bound[i], who.limit), more), who.lane, next.rank(i));
    more = hn::AndNot(hn::Gt(next.bound[kNext], who.limit), more);
    who.kept = next.bound[kNext - 1];
  }
  return true;
}

/// The pairs of the particles with many; false if they do not fit.
template <int kTables>
HWY_INLINE bool collect_rest(const Baked& baked, const ReliefTables* relief, const Columns& columns,
                             const QueryBatch& batch, Open& open, Batched& out) {
  for (int from = 0; from < open.count; from += kWidth) {
    Crowded who;
    who.lanes = hn::FirstN(f, static_cast<std::size_t>(open.count - from));
    who.lane = hn::IfThenElseZero(hn::RebindMask(I(), who.lanes), hn::Load(I(), open.lane + from));
    who.p = {hn::GatherIndex(f, batch.x, who.lane), hn::GatherIndex(f, batch.y, who.lane),
             hn::GatherIndex(f, batch.z, who.lane)};
    who.kept = hn::Load(f, open.kept + from);
    who.limit = hn::Load(f, open.limit + from);
    if (!relief)
      collect_all<kTables>(baked, columns, batch, who, open.pairs, out);
    else if (!collect_rising<kTables>(baked, *relief, columns, batch, who, open.pairs, out))
      return false;
  }
  return true;
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
    load_step(batch, from, p);
    bound_vectors(baked, columns, near, p, lowest);
    for (int v = 0; v < kTogether; ++v) first[v] = lowest[v].rank(0);
    answer_each<kTables>(relief, columns, first, p, answers);
    if (!make_room<kTables>((kKept - 1) * kTogether, relief, columns, batch, open.pairs, out)) return false;
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      put(answers[v], relief != nullptr, out, i);
      open.add<kKept, 1>(lanes_below(i, piece.end), lowest[v],
                         bound_limit(baked, answers[v].distance, beyond_m), lanes_from(i));
    }
  }
  return true;
}

/// The answers of one piece that has but one candidate: nothing to choose, and the same shape in every lane.
inline void answer_alone(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                         const Piece& piece, std::size_t ellipsoid, Batched& out) {
  const Shape shape = broadcast(baked.ellipsoids[ellipsoid]);
  const VI name = hn::Set(I(), baked.names[ellipsoid]);
  Shape shapes[kTogether];
  std::fill_n(shapes, kTogether, shape);
  for (int from = piece.begin; from < end_of(piece); from += kStep) {
    V3 p[kTogether];
    Foot feet[kTogether];
    load_step(batch, from, p);
    feet_of(shapes, p, feet);
    for (int v = 0; v < kTogether; ++v) {
      Answer answer = {feet[v].distance, feet[v].distance, {}, name};
      if (relief) {
        const BakedTable& table = relief->tables[ellipsoid];
        const Corrected one =
            corrected(*relief, broadcast(table), shape, feet[v], [&] { return axes_of(table); });
        answer.value = one.value;
        answer.gradient = one.gradient;
      } else {
        answer.gradient = normal_of(shape, feet[v]);
      }
      put(answer, relief != nullptr, out, from + v * kWidth);
    }
  }
}

/// Some pieces of the batch whose candidates are the columns.
template <int kKept, int kTables>
HWY_INLINE bool nearest_of(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                           const Piece* pieces, int count, const Near* near, const Columns& columns,
                           Open& open, Batched& out) {
  open.pairs.count = open.count = 0;
  for (int i = 0; i < count; ++i) {
    if (near[i].count == 1)
      answer_alone(baked, relief, batch, pieces[i], columns.ellipsoid(near[i].index[0]), out);
    else if (!answer_first<kKept, kTables>(baked, relief, batch, pieces[i], near[i], columns, open, out))
      return false;
  }
  if (!collect_rest<kTables>(baked, relief, columns, batch, open, out)) return false;
  flush<kTables>(relief, columns, batch, open.pairs, out);
  if (relief) combine_blended(*relief, pieces[0].begin, end_of(pieces[count - 1]), open.pairs, out);
  return true;
}

struct Scratch {
  Lists lists;
  Open open;
};

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
    (void)collect_unbeaten<false>(source, piece.box, &piece, 1, &rivals, beyond_m, kNoLimit, list);
  };
  in_parts(baked, piece, scratch.lists, find,
           [&](auto tables, const Columns& columns, const Piece* pieces, int count, const Near* lists) {
             (void)work(tables, columns, pieces, count, lists, part);
             take_nearer(piece, part, out);
             return true;
           });
}

/// With relief, each particle of the piece by itself: `work` (batch, pieces, their number, answers out).
/// False if even then there is no room.
template <class Work>
HWY_INLINE bool one_by_one(const QueryBatch& batch, const Piece& piece, Work&& work, Batched& out) {
  alignas(64) float x[kStep], y[kStep], z[kStep];
  Batched alone;
  for (int i = piece.begin; i < piece.end; ++i) {
    std::fill(x, x + kStep, batch.x[i]);
    std::fill(y, y + kStep, batch.y[i]);
    std::fill(z, z + kStep, batch.z[i]);
    const QueryBatch one = places(x, y, z, 1);
    bool near = false;
    const Piece place = piece_of(one, 0, 1, near);
    if (!work(one, &place, 1, alone)) return false;
    out.distance[i] = alone.distance[0];
    out.value[i] = alone.value[0];
    out.gx[i] = alone.gx[0];
    out.gy[i] = alone.gy[0];
    out.gz[i] = alone.gz[0];
    out.name[i] = alone.name[0];
  }
  return true;
}

/// Distance, unit gradient and owner of every particle; false if a place is too far for floats, or more
/// ellipsoids with relief are near one than the kernel has room for.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Scratch& scratch,
                    Batched& out) {
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  const auto find = [&](const auto& source, const Extent& around, const Piece* pieces, int count,
                        Near* lists) {
    return find_near<false>(source, around, pieces, count, beyond_m, kNoLimit, lists);
  };
  const auto answer = [&](auto tables, const QueryBatch& of, const Columns& columns, const Piece* pieces,
                          int count, const Near* lists, Batched& to) {
    Open& open = scratch.open;
    if (relief) return nearest_of<3, tables()>(baked, relief, of, pieces, count, lists, columns, open, to);
    return nearest_of<2, tables()>(baked, nullptr, of, pieces, count, lists, columns, open, to);
  };
  const auto share_among = [&](const QueryBatch& of, const Piece* pieces, int count, Batched& to) {
    const auto work = [&](auto tables, const Columns& columns, const Piece* some, int number,
                          const Near* lists) { return answer(tables, of, columns, some, number, lists, to); };
    return share(baked, relief, pieces, count, scratch.lists, find, work);
  };
  const auto in_part = [&](auto tables, const Columns& columns, const Piece* pieces, int count,
                           const Near* lists,
                           Batched& to) { return answer(tables, batch, columns, pieces, count, lists, to); };
  if (is_kept(baked, relief, beyond_m, batch, scratch.lists) &&
      share_kept(baked, relief, batch, beyond_m, kNoLimit, Columns::Rows::kFeet, scratch.lists,
                 [&](auto tables, const Columns& columns, const Piece* pieces, int count, const Near* lists) {
                   return answer(tables, batch, columns, pieces, count, lists, out);
                 }))
    return true;
  const Blocks blocks(batch);
  if (!blocks.near) return false;
  for (int i = 0; i < blocks.count; ++i) batch.radius_m[i] = blocks.pieces[i].box.radius;
  if (share_again(
          blocks.pieces, blocks.count, scratch.lists,
          [&](auto tables, const Columns& columns, const Piece* pieces, int count, const Near* lists) {
            return answer(tables, batch, columns, pieces, count, lists, out);
          }))
    return true;
  return together_or_apart(
      batch, blocks, [&](const Piece* pieces, int count) { return share_among(batch, pieces, count, out); },
      [&](const Piece& piece) {
        if (relief) return one_by_one(batch, piece, share_among, out);
        nearest_in_parts(baked, piece, beyond_m, scratch, in_part, out);
        return true;
      });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
