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

/// Blocks that share columns, where all their candidates fit into two vectors.
constexpr int kShared = kWidth < 16 ? 1 : kBlocks;
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

  template <int kKept>
  HWY_INLINE void add(const Lowest<kKept>& lowest, V limits, VI lanes) {
    for (int i = 1; i < kKept; ++i)
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
      open.add(lowest[v], bound_limit(baked, answers[v].distance, beyond_m), hn::Iota(I(), i));
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
  Columns columns;
  Open open;
  Near near, of_block[kBlocks];
};

/// Blocks [first, first + blocks) of the batch together; false if the kernel has no room.
HWY_INLINE bool nearest_together(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                                 const Extent* boxes, int first, int blocks, Scratch& s, Batched& out) {
  Extent around = boxes[first];
  for (int block = 1; block < blocks; ++block) around = united(around, boxes[first + block]);
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  if (!find_near(Everything{baked}, &around, 1, beyond_m, &s.near)) return false;
  if (blocks > 1 && s.near.count > 2 * kWidth) return false;
  s.columns.fill(baked, relief, s.near.index, s.near.count);
  bool fits = false;
  with_tables(s.columns, [&](auto tables) {
    if (blocks == 1)
      choose_all(s.columns, s.of_block[0]);
    else
      (void)find_near(AmongColumns<tables()>{s.columns}, boxes + first, blocks, beyond_m, s.of_block);
    fits = relief ? nearest_of<3, tables()>(baked, relief, batch, first, blocks, s.of_block, s.columns,
                                            s.open, out)
                  : nearest_of<2, tables()>(baked, nullptr, batch, first, blocks, s.of_block, s.columns,
                                            s.open, out);
  });
  return fits;
}

/// Distance, unit gradient and owner of every particle; false if the kernel has no room, or a place is too
/// far for floats.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Batched& out) {
  Extent box[kBlocks];
  Scratch scratch;
  const int blocks = (batch.count + kBlock - 1) / kBlock;
  for (int block = 0; block < blocks; ++block) {
    const int begin = block * kBlock;
    bool near = false;
    box[block] = extent_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin,
                                 std::min(kBlock, batch.count - begin), near);
    if (!near) return false;
    batch.radius_m[block] = box[block].radius;
  }
  for (int first = 0; first < blocks; first += kShared) {
    const int count = std::min(kShared, blocks - first);
    if (nearest_together(baked, relief, batch, box, first, count, scratch, out)) continue;
    if (count == 1) return false;
    for (int block = first; block < first + count; ++block)
      if (!nearest_together(baked, relief, batch, box, block, 1, scratch, out)) return false;
  }
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
