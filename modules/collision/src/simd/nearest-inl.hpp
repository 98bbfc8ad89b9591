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

constexpr int kVectors = kBlock / kWidth;
constexpr int kTogether = kVectors < 2 ? kVectors : 2;  // vectors that are worked on in step

/// The bounds of a block's candidates at the vectors from lane `from` of the batch on.
template <int kKept>
HWY_INLINE void bound_vectors(const Baked& baked, const Near& near, const V3 (&p)[kTogether],
                              Lowest<kKept> (&out)[kTogether]) {
  for (Lowest<kKept>& lowest : out) lowest.clear();
  for (int r = 0; r < near.count; ++r) {
    const BoundEllipsoid& e = baked.bounds[static_cast<std::size_t>(near.index[r])];
    const VI rank = hn::Set(I(), r);
    for (int v = 0; v < kTogether; ++v) out[v].add(lower_bound(e, p[v]), rank);
  }
}

/// All candidates but the first kept ones whose bound is not above the limit, for lanes with so many.
template <int kKept>
HWY_INLINE bool collect_rest(const Baked& baked, const Near& near, V3 p, V limit, VI lanes, M many,
                             const Lowest<kKept>& lowest, Pairs& pairs) {
  for (int r = 0; r < near.count; ++r) {
    const VI rank = hn::Set(I(), r);
    M may = hn::AndNot(hn::Gt(lower_bound(baked.bounds[static_cast<std::size_t>(near.index[r])], p), limit),
                       many);
    for (int i = 0; i < kKept; ++i) may = hn::AndNot(hn::RebindMask(f, hn::Eq(lowest.rank(i), rank)), may);
    if (hn::AllFalse(f, may)) continue;
    if (!pairs.fits()) return false;
    pairs.add(may, lanes, rank);
  }
  return true;
}

/// The pairs of one vector that its first answers leave open; false if they do not fit.
template <int kKept>
HWY_INLINE bool collect(const Baked& baked, const Near& near, V3 p, V limit, int i,
                        const Lowest<kKept>& lowest, Pairs& pairs) {
  const VI lanes = hn::Iota(I(), i);
  for (int kept = 1; kept < kKept; ++kept) {
    if (!pairs.fits()) return false;
    pairs.add(hn::Not(hn::Gt(lowest.bound[kept], limit)), lanes, lowest.rank(kept));
  }
  const M many = hn::Not(hn::Gt(lowest.bound[kKept], limit));
  return hn::AllFalse(f, many) || collect_rest(baked, near, p, limit, lanes, many, lowest, pairs);
}

/// Of its lanes, in whole groups of vectors.
HWY_INLINE int end_of_block(const QueryBatch& batch, int begin) {
  constexpr int kGroup = kTogether * kWidth;
  return begin + (std::min(kBlock, batch.count - begin) + kGroup - 1) / kGroup * kGroup;
}

/// One block of the batch; false if there are more pairs than there is room for.
template <int kKept, int kTables>
HWY_INLINE bool nearest_of(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch, int begin,
                           const Near& near, const Columns& columns, Pairs& pairs, Batched& out) {
  const float beyond_m = relief ? relief->blend_m : 0.0f;
  for (int from = begin; from < end_of_block(batch, begin); from += kTogether * kWidth) {
    V3 p[kTogether];
    Lowest<kKept> lowest[kTogether];
    VI first[kTogether];
    Answer answers[kTogether];
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      p[v] = load3(batch.x + i, batch.y + i, batch.z + i);
    }
    bound_vectors(baked, near, p, lowest);
    for (int v = 0; v < kTogether; ++v) first[v] = lowest[v].rank(0);
    answer_each<kTables>(relief, columns, first, p, answers);
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      put(answers[v], relief != nullptr, out, i);
      const V limit = bound_limit(baked, answers[v].distance, beyond_m);
      if (!collect(baked, near, p[v], limit, i, lowest[v], pairs)) return false;
    }
  }
  return true;
}

HWY_INLINE bool nearest_block(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                              int begin, const Near& near, Columns& columns, Pairs& pairs, Batched& out) {
  columns.fill(baked, relief, near.index, near.count);
  pairs.count = 0;
  bool fits = false;
  with_tables(columns, [&](auto tables) {
    fits = relief ? nearest_of<3, tables()>(baked, relief, batch, begin, near, columns, pairs, out)
                  : nearest_of<2, tables()>(baked, nullptr, batch, begin, near, columns, pairs, out);
  });
  if (!fits) return false;
  answer_pairs(relief, columns, batch, pairs);
  if (relief)
    combine_blended(*relief, begin, end_of_block(batch, begin), pairs, out);
  else
    combine_nearest(pairs, out);
  return true;
}

/// Distance, unit gradient and owner of every particle; false if the kernel has no room.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Batched& out) {
  Near near[kBlocks];
  Extent box[kBlocks];
  Columns columns;
  Pairs pairs;
  const int blocks = (batch.count + kBlock - 1) / kBlock;
  for (int block = 0; block < blocks; ++block) {
    const int begin = block * kBlock;
    box[block] = extent_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin,
                                 std::min(kBlock, batch.count - begin));
    batch.radius_m[block] = box[block].radius;
  }
  if (!find_near(baked, box, blocks, relief ? relief->blend_m : 0.0f, near)) return false;
  for (int block = 0; block < blocks; ++block)
    if (!nearest_block(baked, relief, batch, block * kBlock, near[block], columns, pairs, out)) return false;
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
