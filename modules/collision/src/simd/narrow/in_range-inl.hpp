// The proxy's distance at those particles of a batch that are within a limit of its surface: bounds tell most
// of the others, what is left closes up across the batch, so that only it is paid for, a whole vector at a
// time. The answers have the same bits as without a limit.
#if defined(BODICE_COLLISION_WITHIN_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_WITHIN_INL_
#undef BODICE_COLLISION_WITHIN_INL_
#else
#define BODICE_COLLISION_WITHIN_INL_
#endif

#include "simd/broad/limits-inl.hpp"
#include "simd/narrow/nearest-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// Particles of a batch that may be within the limit, closed up; each run of those that were found together
/// starts at a whole step, behind repetitions of the one before.
struct alignas(64) Reached {
  static constexpr int kMostKept = 3, kSize = kBatch + 2 * kStep;
  float x[kSize], y[kSize], z[kSize];
  float bound[kMostKept + 1][kSize];  ///< as Lowest has them
  std::int32_t lane[kSize];           ///< in the batch; -1: a repetition
  int count = 0;
  LaneBits which;  ///< of the batch

  void clear() {
    count = 0;
    which = {};
  }
  /// Of the batch's lanes [first, first + kWidth).
  template <int kKept>
  HWY_INLINE void add(M mask, int first, V3 p, const Lowest<kKept>& lowest) {
    const Pack pack(mask);
    which.add(bits(mask), first);
    pack.store(p.x, x + count);
    pack.store(p.y, y + count);
    pack.store(p.z, z + count);
    for (int i = 0; i <= kKept; ++i) pack.store(lowest.bound[i], bound[i] + count);
    pack.store(lanes_from(first), lane + count);
    count += pack.count();
  }
  /// Fills up to a whole step; `from` is where the run starts.
  template <int kKept>
  HWY_INLINE void pad(int from) {
    if (count == from) return;
    const int last = count - 1, end = from + (count - from + kStep - 1) / kStep * kStep;
    for (; count < end; ++count) {
      for (float* values : {x, y, z}) values[count] = values[last];
      for (int i = 0; i <= kKept; ++i) bound[i][count] = bound[i][last];
      lane[count] = -1;
    }
  }
  template <int kKept>
  HWY_INLINE Lowest<kKept> lowest(int i) const {
    Lowest<kKept> result;
    for (int k = 0; k <= kKept; ++k) result.bound[k] = hn::Load(f, bound[k] + i);
    return result;
  }
};

/// Three signs, as OctantReach numbers them.
HWY_INLINE VI octant_of(V3 u) {
  const auto bit = [](V v, std::int32_t value) {
    return hn::And(hn::ShiftRight<31>(hn::BitCast(I(), v)), hn::Set(I(), value));
  };
  return hn::Or(bit(u.x, 1), hn::Or(bit(u.y, 2), bit(u.z, 4)));
}

/// The bounds of the columns' ellipsoids above which they leave no particle within the limit, by octants.
class Reaches {
 public:
  HWY_INLINE Reaches(const Baked& baked, const ReliefTables& relief, float limit_m, const Columns& columns) {
    for (int i = 0; i < columns.count(); ++i) {
      const OctantReach& reach = relief.reaches[columns.ellipsoid(i)];
      const BakedEllipsoid& e = baked.ellipsoids[columns.ellipsoid(i)];
      // Only deeper than the least radius of curvature can rounding take the closest point to another octant.
      const V least = all(-0.99f * e.longest_m * e.radius2 * e.radius2);
      const V shift = all(reach.shift_m(limit_m));
      for (int k = 0; k < kOctants; k += kWidth) {
        const V at_zero = hn::MaskedLoad(lanes_below(k, kOctants), f, reach.at_zero_m + k);
        const V limit = bound_limit(baked, hn::Max(hn::Add(at_zero, shift), least), 0.0f);
        hn::StoreU(limit, f, limit_ + i * kOctants + k);
      }
    }
  }
  /// Of one column, and the octants of the lanes.
  HWY_INLINE V operator()(std::int32_t column, VI octant) const {
    const float* const limits = limit_ + column * kOctants;
    if constexpr (kWidth >= kOctants)
      return hn::TableLookupLanes(hn::LoadU(f, limits), hn::IndicesFromVec(f, octant));
    else
      return gathered(limits, octant);
  }

 private:
  static constexpr int kOctants = 8;

#if HWY_TARGET == HWY_SCALAR
  static HWY_INLINE V gathered(const float* limits, VI octant) {
    return all(limits[hn::GetLane(octant)]);
  }
#else
  static HWY_INLINE V gathered(const float* limits, VI octant) {
    return hn::GatherIndex(f, limits, octant);
  }
#endif

  float limit_[kMaxCandidates * kOctants + 16];  // whole vectors are written
};

/// Bounds as bound_vectors() has them; `within` becomes those particles that an ellipsoid leaves within.
template <int kKept>
HWY_INLINE void bound_reached(const Baked& baked, const Columns& columns, const Near& near,
                              const Reaches& reaches, const V3 (&p)[kTogether],
                              Lowest<kKept> (&out)[kTogether], M (&within)[kTogether]) {
  for (int v = 0; v < kTogether; ++v) out[v].clear(), within[v] = hn::FirstN(f, 0);
  for (int i = 0; i < near.count; ++i) {
    const std::int32_t column = near.index[i];
    const BallMap& e = baked.bounds[columns.ellipsoid(column)];
    const VI rank = hn::Set(I(), column);
    for (int v = 0; v < kTogether; ++v) {
      const V3 u = in_ball(e, p[v]);
      const V bound = bound_in_ball(e, u);
      out[v].add(bound, rank);
      within[v] = hn::Or(within[v], hn::Le(bound, reaches(column, octant_of(u))));
    }
  }
}

/// The particles of a piece that may be within the limit. `reaches` is not null with relief.
template <int kKept>
HWY_INLINE void reach(const Baked& baked, const QueryBatch& batch, float limit_m, const Reaches* reaches,
                      const Piece& piece, const Near& near, const Columns& columns, Reached& out) {
  const V limit = bound_limit(baked, all(limit_m), 0.0f);
  for (int from = piece.begin; from < piece.end; from += kStep) {
    V3 p[kTogether];
    Lowest<kKept> lowest[kTogether];
    M within[kTogether];
    load_step(batch, from, p);
    if (reaches) {
      bound_reached(baked, columns, near, *reaches, p, lowest, within);
    } else {
      bound_vectors(baked, columns, near, p, lowest);
      for (int v = 0; v < kTogether; ++v) within[v] = hn::Not(hn::Gt(lowest[v].bound[0], limit));
    }
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      out.add(hn::And(within[v], lanes_below(i, piece.end)), i, p[v], lowest[v]);
    }
  }
}

/// The first answers to the particles [begin, reached.count); false if there is no room for what they leave
/// open.
template <int kKept, int kTables>
HWY_INLINE bool answer_reached(const Baked& baked, const ReliefTables* relief, float limit_m,
                               const Reached& reached, const QueryBatch& at, int begin,
                               const Columns& columns, Open& open, Batched& out) {
  const float beyond_m = relief ? relief->blend_m : 0.0f;
  for (int from = begin; from < reached.count; from += kStep) {
    V3 p[kTogether];
    VI first[kTogether];
    Answer answers[kTogether];
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      p[v] = load3(reached.x + i, reached.y + i, reached.z + i);
      first[v] = reached.lowest<kKept>(i).rank(0);
    }
    answer_each<kTables>(relief, columns, first, p, answers);
    if (!make_room<kTables>((kKept - 1) * kTogether, relief, columns, at, open.pairs, out)) return false;
    for (int v = 0; v < kTogether; ++v) {
      const int i = from + v * kWidth;
      put(answers[v], relief != nullptr, out, i);
      const V least = hn::Min(answers[v].distance, all(limit_m));
      const auto real = hn::RebindMask(f, hn::Gt(hn::Load(I(), reached.lane + i), hn::Set(I(), -1)));
      open.add<kKept, 1>(real, reached.lowest<kKept>(i), bound_limit(baked, least, beyond_m), lanes_from(i));
    }
  }
  return true;
}

/// Some pieces of the batch whose candidates are the columns.
template <int kKept, int kTables>
HWY_INLINE bool within_of(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                          const Limits& limits, const Piece* pieces, int count, const Near* near,
                          const Columns& columns, Reached& reached, Open& open, Batched& out) {
  const int begin = reached.count;
  const auto reach_each = [&](const Reaches* reaches) {
    for (int i = 0; i < count; ++i)
      if (near[i].count > 0)
        reach<kKept>(baked, batch, limits.plain_m, reaches, pieces[i], near[i], columns, reached);
  };
  if (relief) {
    const Reaches reaches(baked, *relief, limits.surface_m, columns);
    reach_each(&reaches);
  } else {
    reach_each(nullptr);
  }
  if (reached.count == begin) return true;
  reached.pad<kKept>(begin);
  const QueryBatch at = places(reached.x, reached.y, reached.z, reached.count);
  open.pairs.count = open.count = 0;
  if (!answer_reached<kKept, kTables>(baked, relief, limits.plain_m, reached, at, begin, columns, open, out))
    return false;
  if (!collect_rest<kTables>(baked, relief, columns, at, open, out)) return false;
  flush<kTables>(relief, columns, at, open.pairs, out);
  if (relief) combine_blended(*relief, begin, reached.count, open.pairs, out);
  return true;
}

/// Distance, unit gradient and owner of every particle that is reached, as `reached` numbers them: all that
/// are within limit_m of the surface, and some others. False if there is no room, or a place too far for
/// floats.
inline bool nearest_within(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, float limit_m,
                           Scratch& scratch, Reached& reached, Batched& out) {
  const Limits limits(baked, relief, limit_m);
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  const auto work = [&](auto tables, const Columns& columns, const Piece* pieces, int count,
                        const Near* lists) {
    Open& open = scratch.open;
    if (relief)
      return within_of<3, tables()>(baked, relief, batch, limits, pieces, count, lists, columns, reached,
                                    open, out);
    return within_of<2, tables()>(baked, nullptr, batch, limits, pieces, count, lists, columns, reached, open,
                                  out);
  };
  reached.clear();
  if (is_kept(baked, relief, beyond_m, batch, scratch.lists)) {
    if (share_kept(baked, relief, batch, beyond_m, limits.of_bounds(baked), Columns::Rows::kFeet,
                   scratch.lists, work))
      return true;
    reached.clear();
  }
  return share_within(baked, relief, batch, beyond_m, limits, scratch.lists, work);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
