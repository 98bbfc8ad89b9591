// The proxy's exact distance at every particle of a batch.
#if defined(BODICE_COLLISION_NEAREST_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NEAREST_INL_
#undef BODICE_COLLISION_NEAREST_INL_
#else
#define BODICE_COLLISION_NEAREST_INL_
#endif

#include <algorithm>
#include <limits>

#include "model/fallback.hpp"
#include "simd/broad/cache-inl.hpp"
#include "simd/broad/domination-inl.hpp"
#include "simd/narrow/narrow_phase-inl.hpp"
#include "simd/narrow/uncertain-inl.hpp"
#include "simd/narrow/unions-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

static_assert(kBlock % kStep == 0);

/// One step of particles of a range, with the lowest bounds of their candidates.
template <int kLowest>
struct RangeStep {
  LowestBounds<kLowest> bounds[kVectorsInStep];
  int from, end;

  HWY_INLINE const LowestBounds<kLowest>& lowest(int v) const { return bounds[v]; }
  HWY_INLINE M lanes(int v) const { return lanes_below(from + v * kWidth, end); }
  HWY_INLINE V least(int, V distance) const { return distance; }
};

/// Evaluates ranges of lanes of a batch among their candidates.
template <class Union>
struct Evaluation {
  Kernel<Union>& kernel;
  const Batch& batch;
  BatchResults& out;

  Status operator()(const Candidates& among) const {
    return with_tables(among.columns, [&](auto tables) { return evaluate<tables()>(among); });
  }

 private:
  template <int kTables>
  HWY_INLINE Status evaluate(const Candidates& among) const {
    NarrowPhase<Union> narrow(kernel.proxy, batch, kernel.open, out);
    narrow.start();
    for (int i = 0; i < among.count; ++i) {
      const LaneRange& range = among.ranges[i];
      if (among.lists[i].count == 1)
        narrow.evaluate_single(range, among.columns.ellipsoid(among.lists[i].index[0]));
      else if (!evaluate_range<kTables>(narrow, range, among.lists[i], among.columns))
        return Status::kTooMany;
    }
    return narrow.template finish<kTables>(among.columns,
                                           {among.ranges[0].begin, end_of(among.ranges[among.count - 1])});
  }
  template <int kTables>
  static HWY_INLINE bool evaluate_range(NarrowPhase<Union>& narrow, const LaneRange& range,
                                        const CandidateList& candidates, const Columns& columns) {
    for (int from = range.begin; from < end_of(range); from += kStep) {
      V3 p[kVectorsInStep];
      RangeStep<Union::kLowest> step;
      step.from = from, step.end = range.end;
      load_step(narrow.batch(), from, p);
      narrow.bound_step(columns, candidates, p, step.bounds);
      if (!narrow.template evaluate_owners<kTables>(columns, from, p, step)) return false;
    }
    return true;
  }
};

/// Takes the nearer of two results for the lanes of a range; of equally near ones that of the lowest index.
HWY_INLINE void take_nearer(const LaneRange& range, const BatchResults& other, BatchResults& out) {
  for (int i = range.begin; i < range.end; ++i) {
    if (other.distance[i] > out.distance[i]) continue;
    if (other.distance[i] == out.distance[i] && other.proxy_index[i] > out.proxy_index[i]) continue;
    out.distance[i] = other.distance[i];
    out.gx[i] = other.gx[i];
    out.gy[i] = other.gy[i];
    out.gz[i] = other.gz[i];
    out.proxy_index[i] = other.proxy_index[i];
  }
}

/// Evaluates some lanes against plain ellipsoids when these are more than the lists hold.
inline Status nearest_in_parts(Kernel<PlainUnion>& kernel, const Batch& batch, LaneSpan lanes,
                               const NotDominated<false>& rule, BatchResults& out) {
  const LaneRange range = Blocks(batch.at, lanes).ranges[0];
  const AllEllipsoids everything(kernel.model().baked);
  Dominators dominators[1];
  find_dominators(everything, range.box, &range, 1, dominators);
  measure_corners(everything, &range, 1, dominators);
  BatchResults part;
  std::fill(out.distance + range.begin, out.distance + range.end, std::numeric_limits<float>::infinity());
  const auto find = [&](const AllEllipsoids& source, CandidateList& list) {
    (void)rule.collect(source, range.box, &range, dominators, &list);
  };
  const Evaluation<PlainUnion> evaluate{kernel, batch, part};
  kernel.broad.search_in_parts(range, find, [&](const Candidates& among) {
    (void)evaluate(among);
    take_nearer(range, part, out);
    return Status::kDone;
  });
  return Status::kDone;
}

/// Evaluates each particle with relief of some lanes by itself; returns kTooMany on overflow even then.
template <class Union>
Status nearest_one_by_one(Kernel<Union>& kernel, const Batch& batch, LaneSpan lanes,
                          const NotDominated<false>& rule, BatchResults& out) {
  alignas(64) float x[kStep], y[kStep], z[kStep];
  BatchResults alone;
  for (int i = lanes.begin; i < lanes.end; ++i) {
    std::fill(x, x + kStep, batch.at.x[i]);
    std::fill(y, y + kStep, batch.at.y[i]);
    std::fill(z, z + kStep, batch.at.z[i]);
    const Batch one{.at = {x, y, z, 1}};
    const Blocks block(one.at, {0, 1});
    const Status status = kernel.broad.search(block.ranges, 1, rule, Evaluation<Union>{kernel, one, alone});
    if (status != Status::kDone) return status;
    copy_result(alone, 0, out, i);
    if constexpr (Union::kBuries) out.unburied[i] = alone.unburied[0];
  }
  return Status::kDone;
}

inline Status nearest_at_last(Kernel<PlainUnion>& kernel, const Batch& batch, LaneSpan lanes,
                              const NotDominated<false>& rule, BatchResults& out) {
  return nearest_in_parts(kernel, batch, lanes, rule, out);
}
template <bool kPosed>
Status nearest_at_last(Kernel<TableUnion<kPosed>>& kernel, const Batch& batch, LaneSpan lanes,
                       const NotDominated<false>& rule, BatchResults& out) {
  return nearest_one_by_one(kernel, batch, lanes, rule, out);
}

/// Results of every particle among its candidates.
template <class Union>
Status nearest_candidates(Kernel<Union>& kernel, Batch& batch, BatchResults& out) {
  const float beyond_m = kernel.beyond_m();
  const NotDominated<false> rule{beyond_m};
  const Evaluation<Union> evaluate{kernel, batch, out};
  if (refresh_if_stale<NotDominated<false>>(beyond_m, batch, kernel.broad) &&
      kernel.broad.take_cached(batch, beyond_m, kNoLimit_m, Columns::Rows::kShapes, evaluate) ==
          Status::kDone)
    return Status::kDone;
  constexpr int kSizes[] = {kBlock, kStep};
  return with_fallback(
      {0, batch.at.count}, kSizes,
      [&](LaneSpan lanes) {
        const Blocks blocks(batch.at, lanes);
        if (!blocks.in_float_range) return Status::kTooFar;
        if (lanes.size() == batch.at.count) {
          blocks.note_radii(batch.radius_m);
          if (kernel.broad.search_again(blocks, evaluate)) return Status::kDone;
        }
        return kernel.broad.search(blocks.ranges, blocks.count, rule, evaluate);
      },
      [&](LaneSpan lanes) { return nearest_at_last(kernel, batch, lanes, rule, out); });
}

/// Distance, unit gradient and owner of every particle. kTooMany if more ellipsoids with relief are near one
/// than the lists hold.
template <class Union>
HWY_INLINE Status nearest(Kernel<Union>& kernel, Batch& batch, BatchResults& out) {
  const Status status = nearest_candidates(kernel, batch, out);
  if constexpr (Union::kBuries)
    if (status == Status::kDone) return resolve_uncertain(kernel, batch.at, out);
  return status;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
