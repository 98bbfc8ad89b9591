// The proxy's distance at the particles of a batch within a limit of its surface. Bounds exclude most of the
// others; the rest are closed up across the batch, so that only they cost closest points, a whole vector at a
// time. The results have the same bits as without a limit.
#if defined(BODICE_COLLISION_IN_RANGE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_IN_RANGE_INL_
#undef BODICE_COLLISION_IN_RANGE_INL_
#else
#define BODICE_COLLISION_IN_RANGE_INL_
#endif

#include "simd/broad/limits-inl.hpp"
#include "simd/narrow/nearest-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The particles of a batch that may be within the limit, closed up. Each run of those found together starts
/// at a whole step, behind repetitions of the particle before.
struct alignas(64) InRange {
  static constexpr int kMaxBounds = 3, kSize = kBatch + 2 * kStep;
  float x[kSize], y[kSize], z[kSize];
  float bound[kMaxBounds + 1][kSize];  ///< as in LowestBounds
  std::int32_t lane[kSize];            ///< in the batch; -1: a repetition
  int count = 0;
  LaneBits which;  ///< these particles as lanes of the batch

  void clear() {
    count = 0;
    which = {};
  }
  /// Adds the chosen ones of the batch's lanes [first, first + kWidth).
  template <int kLowest>
  HWY_INLINE void add(M mask, int first, V3 p, const LowestBounds<kLowest>& lowest) {
    const Pack pack(mask);
    which.add(bits(mask), first);
    pack.store(p.x, x + count);
    pack.store(p.y, y + count);
    pack.store(p.z, z + count);
    for (int i = 0; i <= kLowest; ++i) pack.store(lowest.bound[i], bound[i] + count);
    pack.store(lanes_from(first), lane + count);
    count += pack.count();
  }
  /// Repeats the last particle until the run that starts at `from` has whole steps.
  template <int kLowest>
  HWY_INLINE void pad(int from) {
    if (count == from) return;
    const int last = count - 1, end = from + (count - from + kStep - 1) / kStep * kStep;
    for (; count < end; ++count) {
      for (float* values : {x, y, z}) values[count] = values[last];
      for (int i = 0; i <= kLowest; ++i) bound[i][count] = bound[i][last];
      lane[count] = -1;
    }
  }
  template <int kLowest>
  HWY_INLINE LowestBounds<kLowest> lowest(int i) const {
    LowestBounds<kLowest> result;
    for (int k = 0; k <= kLowest; ++k) result.bound[k] = hn::Load(f, bound[k] + i);
    return result;
  }
};

/// Index of an octant in OctantReach, from three signs.
HWY_INLINE VI octant_of(V3 u) {
  const auto bit = [](V v, std::int32_t value) {
    return hn::And(hn::ShiftRight<31>(hn::BitCast(I(), v)), hn::Set(I(), value));
  };
  return hn::Or(bit(u.x, 1), hn::Or(bit(u.y, 2), bit(u.z, 4)));
}

/// For each column and octant, the bound above which the ellipsoid leaves no particle within the limit.
class OctantLimits {
 public:
  HWY_INLINE OctantLimits(const Baked& baked, const ReliefTables& relief, float limit_m,
                          const Columns& columns) {
    for (int i = 0; i < columns.count(); ++i) {
      const OctantReach& reach = relief.reaches[columns.ellipsoid(i)];
      const BakedEllipsoid& e = baked.ellipsoids[columns.ellipsoid(i)];
      // Rounding may move the closest point of a particle deeper than the least radius of curvature to
      // another octant; such particles always count as within the limit.
      const V least = all(-0.99f * e.longest_m * e.radius2 * e.radius2);
      const V shift = all(reach.shift_m(limit_m));
      for (int k = 0; k < kOctants; k += kWidth) {
        const V at_zero = hn::MaskedLoad(lanes_below(k, kOctants), f, reach.at_zero_m + k);
        const V limit = bound_limit(baked, hn::Max(hn::Add(at_zero, shift), least), 0.0f);
        hn::StoreU(limit, f, limit_ + i * kOctants + k);
      }
    }
  }
  /// The limits of one column for the octants of the lanes.
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

/// Bounds as in bound_vectors(); `within` becomes the particles that may be within the limit of some
/// ellipsoid.
template <int kLowest>
HWY_INLINE void bound_by_octant(const Baked& baked, const Columns& columns, const CandidateList& candidates,
                                const OctantLimits& octant_limits, const V3 (&p)[kVectorsInStep],
                                LowestBounds<kLowest> (&out)[kVectorsInStep], M (&within)[kVectorsInStep]) {
  for (int v = 0; v < kVectorsInStep; ++v) out[v].clear(), within[v] = hn::FirstN(f, 0);
  for (int i = 0; i < candidates.count; ++i) {
    const std::int32_t column = candidates.index[i];
    const BallMap& e = baked.bounds[columns.ellipsoid(column)];
    const VI rank = hn::Set(I(), column);
    for (int v = 0; v < kVectorsInStep; ++v) {
      const V3 u = in_ball(e, p[v]);
      const V bound = bound_in_ball(e, u);
      out[v].add(bound, rank);
      within[v] = hn::Or(within[v], hn::Le(bound, octant_limits(column, octant_of(u))));
    }
  }
}

/// Adds the particles of a range that may be within the limit. With relief `octant_limits` is not null.
template <int kLowest>
HWY_INLINE void collect_in_range(const Baked& baked, const QueryBatch& batch, float limit_m,
                                 const OctantLimits* octant_limits, const LaneRange& range,
                                 const CandidateList& candidates, const Columns& columns, InRange& out) {
  const V limit = bound_limit(baked, all(limit_m), 0.0f);
  for (int from = range.begin; from < range.end; from += kStep) {
    V3 p[kVectorsInStep];
    LowestBounds<kLowest> lowest[kVectorsInStep];
    M within[kVectorsInStep];
    load_step(batch, from, p);
    if (octant_limits) {
      bound_by_octant(baked, columns, candidates, *octant_limits, p, lowest, within);
    } else {
      bound_vectors(baked, columns, candidates, p, lowest);
      for (int v = 0; v < kVectorsInStep; ++v) within[v] = hn::Not(hn::Gt(lowest[v].bound[0], limit));
    }
    for (int v = 0; v < kVectorsInStep; ++v) {
      const int i = from + v * kWidth;
      out.add(hn::And(within[v], lanes_below(i, range.end)), i, p[v], lowest[v]);
    }
  }
}

/// Evaluates the probable owners of the particles [begin, in_range.count). False on overflow of the pairs
/// that remain open.
template <int kLowest, int kTables>
HWY_INLINE bool evaluate_in_range(const Baked& baked, const ReliefTables* relief, float limit_m,
                                  const InRange& in_range, const QueryBatch& at, int begin,
                                  const Columns& columns, Open& open, BatchResults& out) {
  const float beyond_m = relief ? relief->blend_m : 0.0f;
  for (int from = begin; from < in_range.count; from += kStep) {
    V3 p[kVectorsInStep];
    VI first[kVectorsInStep];
    Result results[kVectorsInStep];
    for (int v = 0; v < kVectorsInStep; ++v) {
      const int i = from + v * kWidth;
      p[v] = load3(in_range.x + i, in_range.y + i, in_range.z + i);
      first[v] = in_range.lowest<kLowest>(i).rank(0);
    }
    evaluate_each<kTables>(relief, columns, first, p, results);
    if (!make_room<kTables>((kLowest - 1) * kVectorsInStep, relief, columns, at, open.pairs, out))
      return false;
    for (int v = 0; v < kVectorsInStep; ++v) {
      const int i = from + v * kWidth;
      put(results[v], relief != nullptr, out, i);
      const V least = hn::Min(results[v].distance, all(limit_m));
      const auto real = hn::RebindMask(f, hn::Gt(hn::Load(I(), in_range.lane + i), hn::Set(I(), -1)));
      open.add<kLowest, 1>(real, in_range.lowest<kLowest>(i), bound_limit(baked, least, beyond_m),
                           lanes_from(i));
    }
  }
  return true;
}

/// Evaluates some ranges of the batch with the columns as candidates.
template <int kLowest, int kTables>
HWY_INLINE bool evaluate_limited(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                                 const QueryLimits& limits, const LaneRange* ranges, int count,
                                 const CandidateList* candidates, const Columns& columns, InRange& in_range,
                                 Open& open, BatchResults& out) {
  const int begin = in_range.count;
  const auto collect_each = [&](const OctantLimits* octant_limits) {
    for (int i = 0; i < count; ++i)
      if (candidates[i].count > 0)
        collect_in_range<kLowest>(baked, batch, limits.plain_m, octant_limits, ranges[i], candidates[i],
                                  columns, in_range);
  };
  if (relief) {
    const OctantLimits octant_limits(baked, *relief, limits.surface_m, columns);
    collect_each(&octant_limits);
  } else {
    collect_each(nullptr);
  }
  if (in_range.count == begin) return true;
  in_range.pad<kLowest>(begin);
  const QueryBatch at = batch_at(in_range.x, in_range.y, in_range.z, in_range.count);
  open.pairs.count = open.count = 0;
  if (!evaluate_in_range<kLowest, kTables>(baked, relief, limits.plain_m, in_range, at, begin, columns, open,
                                           out))
    return false;
  if (!collect_rest<kTables>(baked, relief, columns, at, open, out)) return false;
  flush<kTables>(relief, columns, at, open.pairs, out);
  if (relief) combine_blended(*relief, begin, in_range.count, open.pairs, out);
  return true;
}

/// Distance, unit gradient and owner of every particle of `in_range`, as numbered there: all particles within
/// limit_m of the surface, and some others. False on overflow, or if a particle is too far away for floats.
inline bool nearest_in_range(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, float limit_m,
                             Scratch& scratch, InRange& in_range, BatchResults& out) {
  const QueryLimits limits(baked, relief, limit_m);
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  const auto work = [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
                        const CandidateList* lists) {
    Open& open = scratch.open;
    if (relief)
      return evaluate_limited<3, tables()>(baked, relief, batch, limits, ranges, count, lists, columns,
                                           in_range, open, out);
    return evaluate_limited<2, tables()>(baked, nullptr, batch, limits, ranges, count, lists, columns,
                                         in_range, open, out);
  };
  in_range.clear();
  if (use_cache(baked, relief, beyond_m, batch, scratch.lists)) {
    if (with_cached_candidates(baked, relief, batch, beyond_m, limits.of_bounds(baked),
                               Columns::Rows::kShapes, scratch.lists, work))
      return true;
    in_range.clear();
  }
  return with_limited_candidates(baked, relief, batch, beyond_m, limits, scratch.lists, work);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
