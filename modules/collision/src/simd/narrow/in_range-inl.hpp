// The proxy's distance at the particles of a batch within a limit of its surface. Bounds exclude most of the
// others; the rest are closed up across the batch, so that only they cost closest points, a whole vector at a
// time. The results have the same bits as without a limit.
#if defined(BODICE_COLLISION_IN_RANGE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_IN_RANGE_INL_
#undef BODICE_COLLISION_IN_RANGE_INL_
#else
#define BODICE_COLLISION_IN_RANGE_INL_
#endif

#include "simd/broad/cache-inl.hpp"
#include "simd/broad/domination-inl.hpp"
#include "simd/narrow/narrow_phase-inl.hpp"
#include "simd/narrow/uncertain-inl.hpp"
#include "simd/narrow/unions-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// One step of particles: their positions, bounds, and which may be within the limit.
template <int kLowest>
struct InRangeStep {
  V3 p[kVectorsInStep];
  LowestBounds<kLowest> lowest[kVectorsInStep];
  M within[kVectorsInStep];
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
  HWY_INLINE OctantLimits(const ProxyModel& model, float limit_m, const Columns& columns) {
    const Baked& baked = model.baked;
    for (int i = 0; i < columns.count(); ++i) {
      const OctantReach& reach = model.relief->reaches[columns.ellipsoid(i)];
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
      return lookup_lanes(hn::LoadU(f, limits), lane_indices(octant));
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

/// Bounds as in NarrowPhase::bound_step(); `within` becomes the particles that may be within the limit of
/// some ellipsoid.
template <int kLowest>
HWY_INLINE void bound_by_octant(const Baked& baked, const Columns& columns, const CandidateList& candidates,
                                const OctantLimits& octant_limits, InRangeStep<kLowest>& step) {
  for (int v = 0; v < kVectorsInStep; ++v) step.lowest[v].clear(), step.within[v] = hn::FirstN(f, 0);
  for (int i = 0; i < candidates.count; ++i) {
    const std::int32_t column = candidates.index[i];
    const BallMap& e = baked.bounds[columns.ellipsoid(column)];
    const VI rank = hn::Set(I(), column);
    for (int v = 0; v < kVectorsInStep; ++v) {
      const V3 u = in_ball(e, step.p[v]);
      const V bound = bound_in_ball(e, u);
      step.lowest[v].add(bound, rank);
      step.within[v] = hn::Or(step.within[v], hn::Le(bound, octant_limits(column, octant_of(u))));
    }
  }
}

/// Evaluates ranges of lanes of a batch among their candidates, where particles are within the limits.
template <class Union>
struct EvaluationInRange {
  Kernel<Union>& kernel;
  const Batch& batch;
  const QueryLimits& limits;
  InRange& in_range;
  BatchResults& out;

  Status operator()(const Candidates& among) const {
    const int begin = in_range.count;
    collect(among);
    if (in_range.count == begin) return Status::kDone;
    in_range.pad<kLowest>(begin);
    return with_tables(among.columns, [&](auto tables) { return evaluate<tables()>(begin, among.columns); });
  }

 private:
  static constexpr int kLowest = Union::kLowest;

  /// One step of InRange; see RangeStep.
  struct Step {
    const InRange& in_range;
    int from;
    float limit_m;

    HWY_INLINE LowestBounds<kLowest> lowest(int v) const {
      return in_range.lowest<kLowest>(from + v * kWidth);
    }
    HWY_INLINE M lanes(int v) const {
      return hn::RebindMask(f, hn::Gt(hn::Load(I(), in_range.lane + from + v * kWidth), hn::Set(I(), -1)));
    }
    HWY_INLINE V least(int, V distance) const {
      // A score may exceed the limit where the surface is within it.
      if constexpr (Union::kBuries) return distance;
      return hn::Min(distance, all(limit_m));
    }
  };

  /// Adds the particles that may be within the limits.
  HWY_INLINE void collect(const Candidates& among) const {
    // Where an ellipsoid is buried another one, which need not be a candidate, may be within the limit.
    if constexpr (Union::kBlends && !Union::kBuries) {
      const OctantLimits octant_limits(kernel.model(), limits.surface_m, among.columns);
      collect_each(among, [&](const CandidateList& list, InRangeStep<kLowest>& step) {
        bound_by_octant(kernel.model().baked, among.columns, list, octant_limits, step);
      });
    } else {
      const NarrowPhase<Union> narrow(kernel.proxy, batch, kernel.open, out);
      const V limit = bound_limit(kernel.model().baked, all(limits.plain_m), 0.0f);
      collect_each(among, [&](const CandidateList& list, InRangeStep<kLowest>& step) {
        narrow.bound_step(among.columns, list, step.p, step.lowest);
        for (int v = 0; v < kVectorsInStep; ++v)
          step.within[v] = hn::Not(hn::Gt(step.lowest[v].bound[0], limit));
      });
    }
  }
  /// `bound` (candidates, step) sets the bounds of a step, and which of its particles may be within the
  /// limits.
  template <class Bound>
  HWY_INLINE void collect_each(const Candidates& among, Bound&& bound) const {
    for (int i = 0; i < among.count; ++i) {
      const LaneRange& range = among.ranges[i];
      if (among.lists[i].count == 0) continue;
      for (int from = range.begin; from < range.end; from += kStep) {
        InRangeStep<kLowest> step;
        load_step(batch, from, step.p);
        bound(among.lists[i], step);
        for (int v = 0; v < kVectorsInStep; ++v) {
          const int lane = from + v * kWidth;
          in_range.add(hn::And(step.within[v], lanes_below(lane, range.end)), lane, step.p[v],
                       step.lowest[v]);
        }
      }
    }
  }
  /// Evaluates the particles [begin, in_range.count).
  template <int kTables>
  HWY_INLINE Status evaluate(int begin, const Columns& columns) const {
    const Batch at{.at = {in_range.x, in_range.y, in_range.z, in_range.count}};
    NarrowPhase<Union> narrow(kernel.proxy, at, kernel.open, out);
    narrow.start();
    for (int from = begin; from < in_range.count; from += kStep) {
      V3 p[kVectorsInStep];
      for (int v = 0; v < kVectorsInStep; ++v) {
        const int i = from + v * kWidth;
        p[v] = load3(in_range.x + i, in_range.y + i, in_range.z + i);
      }
      const Step step{in_range, from, limits.plain_m};
      if (!narrow.template evaluate_owners<kTables>(columns, from, p, step)) return Status::kTooMany;
    }
    return narrow.template finish<kTables>(columns, {begin, in_range.count});
  }
};

/// Results of the particles of nearest_in_range() among their candidates.
template <class Union>
Status nearest_candidates_in_range(Kernel<Union>& kernel, Batch& batch, float limit_m, InRange& in_range,
                                   BatchResults& out) {
  const QueryLimits limits(kernel.model(), limit_m);
  const float beyond_m = kernel.beyond_m();
  const EvaluationInRange<Union> evaluate{kernel, batch, limits, in_range, out};
  in_range.clear();
  if (refresh_if_stale<NotDominated<false>>(beyond_m, batch, kernel.broad)) {
    if (kernel.broad.take_cached(batch, beyond_m, limits.of_bounds(kernel.model().baked),
                                 Columns::Rows::kShapes, evaluate) == Status::kDone)
      return Status::kDone;
    in_range.clear();
  }
  const Blocks blocks(batch.at, {0, batch.at.count});
  if (!blocks.in_float_range) return Status::kTooFar;
  blocks.note_radii(batch.radius_m);
  const NotBeyondNorDominated rule(limits.plain_m, beyond_m, blocks.ranges[0].box);
  return kernel.broad.search(blocks.ranges, blocks.count, rule, evaluate);
}

/// Distance, unit gradient and owner of every particle of `in_range`, as numbered there: all particles within
/// limit_m of the surface, and some others.
template <class Union>
HWY_INLINE Status nearest_in_range(Kernel<Union>& kernel, Batch& batch, float limit_m, InRange& in_range,
                                   BatchResults& out) {
  const Status status = nearest_candidates_in_range(kernel, batch, limit_m, in_range, out);
  if constexpr (Union::kBuries)
    if (status == Status::kDone)
      return resolve_uncertain(kernel, {in_range.x, in_range.y, in_range.z, in_range.count}, out);
  return status;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
