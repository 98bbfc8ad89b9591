// The proxy's distance at every particle of a batch, exactly.
// A first-order bound of the distance to every candidate of a block finds the probable owner; its exact foot
// then leaves, at nearly every particle, no other candidate whose bound is below. What is left (of plain
// ellipsoids one in ten particles, of blended ones three in four) is collected from the whole batch, so that
// it fills vectors again.
#if defined(BODICE_COLLISION_NEAREST_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NEAREST_INL_
#undef BODICE_COLLISION_NEAREST_INL_
#else
#define BODICE_COLLISION_NEAREST_INL_
#endif

#include "simd/bound-inl.hpp"
#include "simd/combine-inl.hpp"
#include "simd/near-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kVectors = kBlock / kWidth;
constexpr int kStrip = kVectors < 2 ? kVectors : 2;  // vectors that share the broadcast of an ellipsoid
constexpr int kWords = kMaxCandidates / 64;

/// The bounds of a block's candidates at its particles.
struct Bounds {
  alignas(64) float at[kMaxCandidates][kBlock];
  alignas(64) std::int32_t first[kBlock];  ///< the candidate of the least bound
};

HWY_INLINE void bound_strip(const Baked& baked, const Near& near, const QueryBatch& batch, int begin,
                            int strip, Bounds& out) {
  V3 p[kStrip];
  V least[kStrip];
  VI first[kStrip];
  for (int v = 0; v < kStrip; ++v) {
    const int i = begin + strip + v * kWidth;
    p[v] = load3(batch.x + i, batch.y + i, batch.z + i);
    least[v] = all(1e30f);
    first[v] = hn::Zero(I());
  }
  for (int r = 0; r < near.count; ++r) {
    const BoundEllipsoid& e = baked.bounds[static_cast<std::size_t>(near.index[r])];
    const VI rank = hn::Set(I(), r);
    for (int v = 0; v < kStrip; ++v) {
      const V bound = lower_bound(e, p[v]);
      hn::Store(bound, f, out.at[r] + strip + v * kWidth);
      const M lower = hn::Lt(bound, least[v]);
      least[v] = hn::IfThenElse(lower, bound, least[v]);
      first[v] = hn::IfThenElse(hn::RebindMask(I(), lower), rank, first[v]);
    }
  }
  for (int v = 0; v < kStrip; ++v) hn::Store(first[v], I(), out.first + strip + v * kWidth);
}

/// The next candidates of the set that fit into the table, and which lanes ask for them (-1: not these).
HWY_INLINE void next_columns(const Baked& baked, const ReliefTables* relief, const Near& near,
                             const Bounds& bounds, std::uint64_t (&left)[kWords], Columns& columns,
                             VI (&column)[kVectors]) {
  columns.count = 0;
  for (VI& c : column) c = hn::Set(I(), -1);
  for (int word = 0; word < kWords; ++word)
    for (; left[word] != 0 && !columns.full(); left[word] &= left[word] - 1) {
      const int r = 64 * word + std::countr_zero(left[word]);
      const VI c = hn::Set(I(), columns.add(baked, relief, near.index[r]));
      for (int v = 0; v < kVectors; ++v) {
        const auto mine = hn::Eq(hn::Load(I(), bounds.first + v * kWidth), hn::Set(I(), r));
        column[v] = hn::IfThenElse(mine, c, column[v]);
      }
    }
}

/// What the probable owners of a block say.
HWY_INLINE void answer_first(const Baked& baked, const ReliefTables* relief, const Near& near,
                             const Bounds& bounds, const QueryBatch& batch, int begin, Batched& out) {
  std::uint64_t left[kWords] = {};
  for (int lane = 0; lane < kBlock; ++lane) {
    const auto r = static_cast<unsigned>(bounds.first[lane]);
    left[r / 64] |= std::uint64_t{1} << (r % 64);
  }
  Columns columns;
  VI column[kVectors];
  while (true) {
    next_columns(baked, relief, near, bounds, left, columns, column);
    if (columns.count == 0) return;
    with_tables(columns, [&](auto tables) {
      for (int v = 0; v < kVectors; ++v) {
        const int i = begin + v * kWidth;
        const M mine = hn::RebindMask(f, hn::Gt(column[v], hn::Set(I(), -1)));
        if (hn::AllFalse(f, mine)) continue;
        const V3 p = load3(batch.x + i, batch.y + i, batch.z + i);
        const Answer a = answer<tables()>(relief, columns, hn::Max(column[v], hn::Zero(I())), p);
        if (hn::AllTrue(f, mine))
          put(a, relief, out, i);
        else
          put_where(mine, a, out, i);
      }
    });
    if (!columns.full()) return;
  }
}

/// Lanes whose bound for a candidate other than the first is not above the limit.
HWY_INLINE M may_count(const Bounds& bounds, int r, int v, VI first, V limit) {
  const M above = hn::Gt(hn::Load(f, bounds.at[r] + v * kWidth), limit);
  return hn::Not(hn::Or(above, hn::RebindMask(f, hn::Eq(first, hn::Set(I(), r)))));
}

/// The pairs of one vector that its first answers leave open; false if they do not fit.
HWY_INLINE bool collect(const Baked& baked, const ReliefTables* relief, const Near& near,
                        const Bounds& bounds, const QueryBatch& batch, int begin, int v, V limit,
                        Pairs& pairs) {
  const VI first = hn::Load(I(), bounds.first + v * kWidth);
  for (int chunk = 0; chunk < near.count; chunk += 64) {
    // Which candidates any lane needs, without a branch each: few do, and not predictably.
    std::uint64_t hit = 0;
    const int end = std::min(64, near.count - chunk);
    for (int r = 0; r < end; ++r)
      hit |= std::uint64_t{!hn::AllFalse(f, may_count(bounds, chunk + r, v, first, limit))} << r;
    for (; hit != 0; hit &= hit - 1) {
      const int r = chunk + std::countr_zero(hit);
      const M may = may_count(bounds, r, v, first, limit);
      if (!pairs.fits()) return false;
      if (pairs.columns.full()) answer_pairs(relief, batch, pairs);
      const VI column = hn::Set(I(), pairs.columns.find_or_add(baked, relief, near.index[r]));
      const VI lanes = hn::Iota(I(), begin + v * kWidth);
      hn::StoreU(hn::Compress(lanes, hn::RebindMask(I(), may)), I(), pairs.lane + pairs.count);
      hn::StoreU(column, I(), pairs.column + pairs.count);
      pairs.count += static_cast<int>(hn::CountTrue(f, may));
    }
  }
  return true;
}

/// One block of the batch; false if more ellipsoids or pairs are near than there is room for.
HWY_INLINE bool nearest_block(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, int begin,
                              Near& near, Bounds& bounds, Pairs& pairs, Batched& out) {
  const float blend_m = relief ? relief->blend_m : 0.0f;
  const Extent e = extent_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin,
                                   std::min(kBlock, batch.count - begin));
  batch.radius_m[begin / kBlock] = e.radius;
  if (!near_box(baked, e, blend_m, near)) return false;
  for (int strip = 0; strip < kBlock; strip += kStrip * kWidth)
    bound_strip(baked, near, batch, begin, strip, bounds);
  answer_first(baked, relief, near, bounds, batch, begin, out);
  // A bound is off by kEstimate of itself and of the longest radius, a distance by the rounding.
  const V slack = all(2.0f * kEstimate * baked.longest_m + 4.0f * baked.rounding_m + blend_m);
  for (int v = 0; v < kVectors; ++v) {
    const V d = hn::Load(f, out.distance + begin + v * kWidth);
    const V limit = hn::Add(hn::MulAdd(all(kEstimate), hn::Abs(d), d), slack);
    if (!collect(baked, relief, near, bounds, batch, begin, v, limit, pairs)) return false;
  }
  return true;
}

/// Distance, unit gradient and owner of every particle; false if the kernel has no room.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Batched& out) {
  Pairs pairs;
  Near near;
  Bounds bounds;
  for (int begin = 0; begin < batch.count; begin += kBlock)
    if (!nearest_block(baked, relief, batch, begin, near, bounds, pairs, out)) return false;
  answer_pairs(relief, batch, pairs);
  if (relief)
    combine_blended(*relief, batch.count, pairs, out);
  else
    combine_nearest(pairs, out);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
