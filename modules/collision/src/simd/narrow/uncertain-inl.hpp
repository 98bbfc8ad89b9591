// Poses: particles with owners that may not be among their candidates. Candidates are found by distance; the
// owner is the ellipsoid of least score. Where the nearest ellipsoids are buried, an ellipsoid that is
// farther than any candidate may own the particle. Its distance is at most its score, which is at most the
// least score among the candidates: all ellipsoids within that score and the blend radius are evaluated.
#if defined(BODICE_COLLISION_UNCERTAIN_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_UNCERTAIN_INL_
#undef BODICE_COLLISION_UNCERTAIN_INL_
#else
#define BODICE_COLLISION_UNCERTAIN_INL_
#endif

#include <algorithm>

#include "model/fallback.hpp"
#include "simd/broad/domination-inl.hpp"
#include "simd/narrow/narrow_phase-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// Copies the result of one lane to another.
HWY_INLINE void copy_result(const BatchResults& from, int lane, BatchResults& to, int to_lane) {
  to.distance[to_lane] = from.distance[lane];
  to.value[to_lane] = from.value[lane];
  to.gx[to_lane] = from.gx[lane];
  to.gy[to_lane] = from.gy[lane];
  to.gz[to_lane] = from.gz[lane];
  to.proxy_index[to_lane] = from.proxy_index[lane];
}

/// The uncertain particles of a batch, closed up.
struct alignas(64) UncertainParticles {
  float x[kBatch], y[kBatch], z[kBatch];
  float score_m[kBatch];  ///< least score among the candidates
  std::int32_t lane[kBatch + 16];
  int count = 0;

  HWY_INLINE UncertainParticles(const Positions& at, const BatchResults& results) {
    for (int i = 0; i < at.count; i += kWidth) {
      const V score = hn::Load(f, results.unburied + i);
      const Pack pack(hn::And(hn::Gt(score, all(kCertain)), lanes_below(i, at.count)));
      pack.store(lanes_from(i), lane + count);
      count += pack.count();
    }
    for (int i = 0; i < count; ++i) put(at, results, i, lane[i]);
    const int end = (count + kBlock - 1) / kBlock * kBlock;
    for (int i = count; i < end; ++i) put(at, results, i, lane[count - 1]);
  }

  /// The score within which all ellipsoids may matter to some of these particles.
  HWY_INLINE float most_m(LaneSpan lanes) const {
    return *std::max_element(score_m + lanes.begin, score_m + lanes.end);
  }

 private:
  HWY_INLINE void put(const Positions& at, const BatchResults& results, int i, int from) {
    x[i] = at.x[from];
    y[i] = at.y[from];
    z[i] = at.z[from];
    score_m[i] = results.unburied[from];
  }
};

/// One step of uncertain particles, with the lowest bounds of their candidates.
template <int kLowest>
struct UncertainStep {
  LowestBounds<kLowest> bounds[kVectorsInStep];
  const float* score_m;
  int from, end;

  HWY_INLINE const LowestBounds<kLowest>& lowest(int v) const { return bounds[v]; }
  HWY_INLINE M lanes(int v) const { return lanes_below(from + v * kWidth, end); }
  HWY_INLINE V least(int v, V score) const {
    return hn::Min(score, hn::Load(f, score_m + from + v * kWidth));
  }
};

/// Evaluates ranges of uncertain particles among all ellipsoids that may matter to them.
template <class Union>
struct EvaluationOfUncertain {
  Kernel<Union>& kernel;
  const Batch& batch;
  const float* score_m;
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
      for (int from = range.begin; from < end_of(range); from += kStep) {
        V3 p[kVectorsInStep];
        UncertainStep<Union::kLowest> step;
        step.score_m = score_m, step.from = from, step.end = range.end;
        load_step(batch, from, p);
        narrow.bound_step(among.columns, among.lists[i], p, step.bounds);
        if (!narrow.template evaluate_owners<kTables>(among.columns, from, p, step)) return Status::kTooMany;
      }
    }
    return narrow.template finish<kTables>(among.columns,
                                           {among.ranges[0].begin, end_of(among.ranges[among.count - 1])});
  }
};

/// Evaluates some uncertain particles; results are numbered as these are.
template <class Union>
HWY_INLINE Status evaluate_uncertain(Kernel<Union>& kernel, const Batch& batch, const float* score_m,
                                     LaneSpan lanes, float most_m, BatchResults& out) {
  const Blocks blocks(batch.at, lanes);
  if (!blocks.in_float_range) return Status::kTooFar;
  const V limit = bound_limit(kernel.model().baked, all(most_m), kernel.model().blend_m());
  return kernel.broad.search(blocks.ranges, blocks.count, NotBeyond{hn::GetLane(limit)},
                             EvaluationOfUncertain<Union>{kernel, batch, score_m, out});
}

/// Evaluates each of some uncertain particles by itself; kTooMany on overflow even then.
template <class Union>
Status evaluate_uncertain_one_by_one(Kernel<Union>& kernel, const UncertainParticles& of, LaneSpan lanes,
                                     BatchResults& out) {
  alignas(64) float x[kStep], y[kStep], z[kStep], score_m[kStep];
  BatchResults alone;
  for (int i = lanes.begin; i < lanes.end; ++i) {
    std::fill(x, x + kStep, of.x[i]);
    std::fill(y, y + kStep, of.y[i]);
    std::fill(z, z + kStep, of.z[i]);
    std::fill(score_m, score_m + kStep, of.score_m[i]);
    const Batch one{.at = {x, y, z, 1}};
    const Status status = evaluate_uncertain(kernel, one, score_m, {0, 1}, of.score_m[i], alone);
    if (status != Status::kDone) return status;
    copy_result(alone, 0, out, i);
  }
  return Status::kDone;
}

/// Replaces the results of the uncertain particles by those among all ellipsoids.
template <class Union>
Status resolve_uncertain(Kernel<Union>& kernel, const Positions& at, BatchResults& results) {
  const UncertainParticles particles(at, results);
  if (particles.count == 0) return Status::kDone;
  kernel.broad.reuse_within(0.0f);  // the candidates of this search serve no other particles
  const Batch batch{.at = {particles.x, particles.y, particles.z, particles.count}};
  BatchResults found;
  constexpr int kSizes[] = {kBlock, kStep};
  const Status status = with_fallback(
      {0, particles.count}, kSizes,
      [&](LaneSpan lanes) {
        return evaluate_uncertain(kernel, batch, particles.score_m, lanes, particles.most_m(lanes), found);
      },
      [&](LaneSpan lanes) { return evaluate_uncertain_one_by_one(kernel, particles, lanes, found); });
  if (status != Status::kDone) return status;
  for (int i = 0; i < particles.count; ++i) copy_result(found, i, results, particles.lane[i]);
  return Status::kDone;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
