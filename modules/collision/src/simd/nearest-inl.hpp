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

/// The pairs of the particles with many; false if they do not fit.
HWY_INLINE bool collect_rest(const Baked& baked, const Columns& columns, const QueryBatch& batch,
                             Open& open) {
  for (int from = 0; from < open.count; from += kWidth) {
    const M valid = hn::FirstN(f, static_cast<std::size_t>(open.count - from));
    const VI lanes = hn::IfThenElseZero(hn::RebindMask(I(), valid), hn::Load(I(), open.lane + from));
    const V3 p = {hn::GatherIndex(f, batch.x, lanes), hn::GatherIndex(f, batch.y, lanes),
                  hn::GatherIndex(f, batch.z, lanes)};
    const V kept = hn::Load(f, open.kept + from), limit = hn::Load(f, open.limit + from);
    for (int i = 0; i < columns.count(); ++i) {
      if (!open.pairs.fit(1)) return false;
      const VI rank = hn::Set(I(), i);
      const V bound = ranked(lower_bound(baked.bounds[columns.ellipsoid(i)], p), rank);
      open.pairs.add(hn::And(valid, hn::AndNot(hn::Gt(bound, limit), hn::Gt(bound, kept))), lanes, rank);
    }
  }
  return true;
}

/// Of its lanes, in whole groups of vectors.
HWY_INLINE int end_of_block(const QueryBatch& batch, int begin) {
  constexpr int kGroup = kTogether * kWidth;
  return begin + (std::min(kBlock, batch.count - begin) + kGroup - 1) / kGroup * kGroup;
}

/// The first answers of one block; false if there is no room for what they leave open.
template <int kKept, int kTables>
HWY_INLINE bool answer_first(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                             int begin, const Near& near, const Columns& columns, Open& open, Batched& out) {
  const float beyond_m = relief ? relief->blend_m : 0.0f;
  for (int from = begin; from < end_of_block(batch, begin); from += kTogether * kWidth) {
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
    if (!open.pairs.fit((kKept - 1) * kTogether)) return false;
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      put(answers[v], relief != nullptr, out, i);
      open.add<kKept, 1>(lowest[v], bound_limit(baked, answers[v].distance, beyond_m), hn::Iota(I(), i));
    }
  }
  return true;
}

/// Some blocks of the batch whose candidates are the columns.
template <int kKept, int kTables>
HWY_INLINE bool nearest_of(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch, int first,
                           int blocks, const Near* near, const Columns& columns, Open& open, Batched& out) {
  open.pairs.count = open.count = 0;
  for (int block = 0; block < blocks; ++block)
    if (!answer_first<kKept, kTables>(baked, relief, batch, (first + block) * kBlock, near[block], columns,
                                      open, out))
      return false;
  if (!collect_rest(baked, columns, batch, open)) return false;
  answer_pairs<kTables>(relief, columns, batch, open.pairs);
  if (relief) {
    const int last = (first + blocks - 1) * kBlock;
    combine_blended(*relief, first * kBlock, end_of_block(batch, last), open.pairs, out);
  } else {
    combine_nearest(open.pairs, out);
  }
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
  Near near, of_block[kBlocks], of_alone;
};

/// Finds the candidates of blocks [first, first + blocks) at once, and among them those of each: `find` (a
/// source, boxes, their number, lists out). Then calls `work` (number of tables, columns, first, blocks,
/// their lists) on all, if their candidates fit into two vectors, or on each. False if either has no room.
template <class Find, class Work>
HWY_INLINE bool share(const Baked& baked, const ReliefTables* relief, const Extent* boxes, int first,
                      int blocks, Scratch& s, Find&& find, Work&& work) {
  Extent around = boxes[first];
  for (int block = 1; block < blocks; ++block) around = united(around, boxes[first + block]);
  if (!find(Everything{baked}, &around, 1, &s.near)) return false;
  if (s.near.count == 0) return true;
  s.columns.fill(baked, relief, s.near.index, s.near.count);
  bool fits = false;
  if (blocks == 1 || s.near.count <= 2 * kWidth) {
    with_tables(s.columns, [&](auto tables) {
      if (blocks == 1)
        choose_all(s.columns, s.of_block[0]);
      else
        (void)find(AmongColumns<tables()>{s.columns}, boxes + first, blocks, s.of_block);
      fits = work(tables, s.columns, first, blocks, s.of_block);
    });
    return fits;
  }
  if (!find(AmongColumns<0>{s.columns}, boxes + first, blocks, s.of_block)) return false;
  for (int block = 0; block < blocks; ++block) {
    Near& list = s.of_block[block];
    if (list.count == 0) continue;
    for (int i = 0; i < list.count; ++i) list.index[i] = s.near.index[list.index[i]];
    s.alone.fill(baked, relief, list.index, list.count);
    choose_all(s.alone, s.of_alone);
    with_tables(s.alone, [&](auto tables) { fits = work(tables, s.alone, first + block, 1, &s.of_alone); });
    if (!fits) return false;
  }
  return true;
}

/// The box of each block of places; false if some place is too far for floats.
HWY_INLINE bool boxes_of(const QueryBatch& batch, Extent* boxes) {
  bool all_near = true;
  for (int begin = 0; begin < batch.count; begin += kBlock) {
    bool near = false;
    boxes[begin / kBlock] = extent_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin,
                                            std::min(kBlock, batch.count - begin), near);
    all_near = all_near && near;
  }
  return all_near;
}

/// What fits together is done together: `work` (first block, blocks).
template <class Work>
HWY_INLINE bool together_or_alone(int count, Work&& work) {
  const int blocks = (count + kBlock - 1) / kBlock;
  if (work(0, blocks)) return true;
  for (int block = 0; block < blocks; ++block)
    if (blocks == 1 || !work(block, 1)) return false;
  return true;
}

/// Distance, unit gradient and owner of every particle; false if the kernel has no room, or a place is too
/// far for floats.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Scratch& scratch,
                    Batched& out) {
  Extent boxes[kBlocks];
  if (!boxes_of(batch, boxes)) return false;
  for (int block = 0; block * kBlock < batch.count; ++block) batch.radius_m[block] = boxes[block].radius;
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  const auto find = [&](const auto& source, const Extent* around, int count, Near* lists) {
    return find_near(source, around, count, beyond_m, lists);
  };
  const auto work = [&](auto tables, const Columns& columns, int first, int blocks, const Near* lists) {
    Open& open = scratch.open;
    if (relief)
      return nearest_of<3, tables()>(baked, relief, batch, first, blocks, lists, columns, open, out);
    return nearest_of<2, tables()>(baked, nullptr, batch, first, blocks, lists, columns, open, out);
  };
  return together_or_alone(batch.count, [&](int first, int blocks) {
    return share(baked, relief, boxes, first, blocks, scratch, find, work);
  });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
