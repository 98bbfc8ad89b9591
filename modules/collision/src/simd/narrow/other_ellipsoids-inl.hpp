// Finds which positions, already pushed clear of one to three ellipsoids, are below the clearance of another.
// Along its normal a convex shape keeps its closest point, and a half-space beyond a tangent plane contains
// no point of the shape. The cleared ellipsoids therefore need no evaluation, and bounds exclude most of the
// others.
#if defined(BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_
#undef BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_
#else
#define BODICE_COLLISION_OTHER_ELLIPSOIDS_INL_
#endif

#include "simd/broad/domination-inl.hpp"
#include "simd/narrow/narrow_phase-inl.hpp"
#include "simd/narrow/unions-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// Positions and the ellipsoids that they were pushed clear of: internal indices, or negative.
struct ClearedPositions {
  const Batch& batch;
  const std::int32_t *first, *second, *third;
};

/// Evaluates ranges of positions among their candidates other than the cleared ones.
struct EvaluationOfOthers {
  Kernel<PlainUnion>& kernel;
  const ClearedPositions& cleared;
  float limit_m;
  BatchResults& out;

  Status operator()(const Candidates& among) const {
    return with_tables(among.columns, [&](auto tables) { return evaluate<tables()>(among); });
  }

 private:
  template <int kTables>
  HWY_INLINE Status evaluate(const Candidates& among) const {
    NarrowPhase<PlainUnion> narrow(kernel.proxy, cleared.batch, kernel.open, out);
    narrow.start();
    const V limit = bound_limit(kernel.model().baked, all(limit_m), 0.0f);
    for (int range = 0; range < among.count; ++range)
      for (int from = among.ranges[range].begin; from < end_of(among.ranges[range]); from += kStep) {
        LowestBounds<1> lowest[kVectorsInStep];
        bound_others(among.columns, among.lists[range], from, lowest);
        (void)narrow.make_room<kTables>(among.columns, kVectorsInStep);
        for (int v = 0; v < kVectorsInStep; ++v) {
          const int i = from + v * kWidth;
          kernel.open.add<1, 0>(lanes_below(i, among.ranges[range].end), lowest[v], limit, lanes_from(i));
        }
      }
    return narrow.finish<kTables>(among.columns, {});
  }
  /// The lowest bound at each position among the ellipsoids that were not cleared.
  HWY_INLINE void bound_others(const Columns& columns, const CandidateList& candidates, int from,
                               LowestBounds<1> (&lowest)[kVectorsInStep]) const {
    const Positions& at = cleared.batch.at;
    V3 p[kVectorsInStep];
    VI first[kVectorsInStep], second[kVectorsInStep], third[kVectorsInStep];
    for (int v = 0; v < kVectorsInStep; ++v) {
      const int i = from + v * kWidth;
      p[v] = load3(at.x + i, at.y + i, at.z + i);
      first[v] = hn::Load(I(), cleared.first + i);
      second[v] = hn::Load(I(), cleared.second + i);
      third[v] = hn::Load(I(), cleared.third + i);
      lowest[v].clear();
    }
    for (int r = 0; r < candidates.count; ++r) {
      const std::size_t k = columns.ellipsoid(candidates.index[r]);
      const VI rank = hn::Set(I(), candidates.index[r]), which = hn::Set(I(), static_cast<std::int32_t>(k));
      for (int v = 0; v < kVectorsInStep; ++v) {
        const auto own =
            hn::Or(hn::Eq(first[v], which), hn::Or(hn::Eq(second[v], which), hn::Eq(third[v], which)));
        const V bound = lower_bound(kernel.model().baked.bounds[k], p[v]);
        lowest[v].add(hn::IfThenElse(hn::RebindMask(f, own), all(1e29f), bound), rank);
      }
    }
  }
};

/// The nearest of the other ellipsoids at each position, exact where it is nearer than the limit, elsewhere
/// some distance beyond it.
inline Status nearest_others(Kernel<PlainUnion>& kernel, const ClearedPositions& cleared, float limit_m,
                             BatchResults& out) {
  const Batch& batch = cleared.batch;
  for (int i = 0; i < batch.at.count; i += kWidth) {
    hn::Store(all(1e30f), f, out.distance + i);
    hn::Store(hn::Zero(I()), I(), out.proxy_index + i);
  }
  const NotBeyond rule{limit_m + 4.0f * kernel.model().baked.rounding_m};
  const EvaluationOfOthers evaluate{kernel, cleared, limit_m, out};
  constexpr int kSizes[] = {kBlock, kStep};
  return with_fallback(
      {0, batch.at.count}, kSizes,
      [&](LaneSpan lanes) {
        const Blocks blocks(batch.at, lanes);
        if (!blocks.in_float_range) return Status::kTooFar;
        return kernel.broad.search(blocks.ranges, blocks.count, rule, evaluate);
      },
      [&](LaneSpan lanes) {
        const LaneRange range = Blocks(batch.at, lanes).ranges[0];
        const auto find = [&](const AllEllipsoids& source, CandidateList& list) {
          (void)rule(source, range.box, &range, 1, &list);
        };
        kernel.broad.search_in_parts(range, find, evaluate);
        return Status::kDone;
      });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
