// Whether places that were put clear of one to three ellipsoids are clear of all others. Since the nearest
// point on a convex shape stays the same along its normal, and a half-space beyond a tangent plane has no
// point of it, those need not be measured again; a bound tells most of the others, so that few
// feet are left.
#if defined(BODICE_COLLISION_CLEAR_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CLEAR_INL_
#undef BODICE_COLLISION_CLEAR_INL_
#else
#define BODICE_COLLISION_CLEAR_INL_
#endif

#include "simd/narrow/nearest-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// Places and what they were put clear of: indices of ellipsoids, or below zero.
struct Placed {
  const QueryBatch& batch;
  const std::int32_t *first, *second, *third;
};

HWY_INLINE void bound_others(const Baked& baked, const Columns& columns, const Near& near,
                             const Placed& placed, int from, Lowest<1> (&out)[kTogether]) {
  V3 p[kTogether];
  VI first[kTogether], second[kTogether], third[kTogether];
  for (int v = 0; v < kTogether; ++v) {
    const int i = from + v * kWidth;
    p[v] = load3(placed.batch.x + i, placed.batch.y + i, placed.batch.z + i);
    first[v] = hn::Load(I(), placed.first + i);
    second[v] = hn::Load(I(), placed.second + i);
    third[v] = hn::Load(I(), placed.third + i);
    out[v].clear();
  }
  for (int r = 0; r < near.count; ++r) {
    const std::size_t k = columns.ellipsoid(near.index[r]);
    const VI rank = hn::Set(I(), near.index[r]), which = hn::Set(I(), static_cast<std::int32_t>(k));
    for (int v = 0; v < kTogether; ++v) {
      const auto own =
          hn::Or(hn::Eq(first[v], which), hn::Or(hn::Eq(second[v], which), hn::Eq(third[v], which)));
      const V bound = lower_bound(baked.bounds[k], p[v]);
      out[v].add(hn::IfThenElse(hn::RebindMask(f, own), all(1e29f), bound), rank);
    }
  }
}

/// Some pieces of the batch whose candidates are the columns.
template <int kTables>
HWY_INLINE bool others_of(const Baked& baked, const Placed& placed, float limit_m, const Piece* pieces,
                          int count, const Near* near, const Columns& columns, Open& open, Batched& out) {
  const QueryBatch& batch = placed.batch;
  open.pairs.count = open.count = 0;
  const V limit = bound_limit(baked, all(limit_m), 0.0f);
  for (int piece = 0; piece < count; ++piece)
    for (int from = pieces[piece].begin; from < end_of(pieces[piece]); from += kStep) {
      Lowest<1> lowest[kTogether];
      bound_others(baked, columns, near[piece], placed, from, lowest);
      (void)make_room<kTables>(kTogether, nullptr, columns, batch, open.pairs, out);
      for (int v = 0; v < kTogether; ++v) {
        const int i = from + v * kWidth;
        open.add<1, 0>(lanes_below(i, pieces[piece].end), lowest[v], limit, lanes_from(i));
      }
    }
  (void)collect_rest<kTables>(baked, nullptr, columns, batch, open, out);
  flush<kTables>(nullptr, columns, batch, open.pairs, out);
  return true;
}

/// The nearest of the other ellipsoids at each place where it is nearer than the limit, exactly; elsewhere
/// some distance beyond the limit. False if a place is too far for floats.
inline bool nearest_others(const Baked& baked, const Placed& placed, float limit_m, Scratch& scratch,
                           Batched& out) {
  const QueryBatch& batch = placed.batch;
  const Blocks blocks(batch);
  if (!blocks.near) return false;
  for (int i = 0; i < batch.count; i += kWidth) {
    hn::Store(all(1e30f), f, out.distance + i);
    hn::Store(hn::Zero(I()), I(), out.name + i);
  }
  const float below_m = limit_m + 4.0f * baked.rounding_m;
  const auto find = [&](const auto& source, const Extent& around, const Piece* pieces, int count,
                        Near* lists) { return find_below(source, around, pieces, count, below_m, lists); };
  const auto work = [&](auto tables, const Columns& columns, const Piece* pieces, int count,
                        const Near* lists) {
    return others_of<tables()>(baked, placed, limit_m, pieces, count, lists, columns, scratch.open, out);
  };
  return together_or_apart(
      batch, blocks,
      [&](const Piece* pieces, int count) {
        return share(baked, nullptr, pieces, count, scratch.lists, find, work);
      },
      [&](const Piece& piece) {
        in_parts(
            baked, piece, scratch.lists,
            [&](const Everything& source, Near* list) {
              (void)find_below(source, piece.box, &piece, 1, below_m, list);
            },
            work);
        return true;
      });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
