// Checks and refreshes the candidate cache of a batch.
#if defined(BODICE_COLLISION_CACHE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CACHE_INL_
#undef BODICE_COLLISION_CACHE_INL_
#else
#define BODICE_COLLISION_CACHE_INL_
#endif

#include <algorithm>
#include <cmath>

#include "model/candidate_cache.hpp"
#include "simd/broad/search-inl.hpp"
#include "simd/ellipsoid/closest_point-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

static_assert(CachedBatch::kSpan % kStep == 0 && kBlock % CachedBatch::kSpan == 0);

/// Updates the bound on the displacement since the last refresh. False if it exceeds the reach for some
/// particle, so that the cache is stale.
HWY_INLINE bool update_displacement(CachedBatch& cached, const Batch& batch) {
  const auto traveled_m = static_cast<float>(batch.cache.traveled_m - cached.traveled_m);
  const float left_m = cached.reach_m - traveled_m;
  if (cached.count < batch.at.count || !(left_m > 0.0f)) return false;
  const V limit = all(left_m * left_m);
  V most = hn::Zero(f);
  M near = hn::FirstN(f, kWidth);
  for (int i = 0; i < batch.at.count; i += kWidth) {
    const V3 p = {hn::LoadU(f, batch.at.x + i), hn::LoadU(f, batch.at.y + i), hn::LoadU(f, batch.at.z + i)};
    const V3 path = p - load3(cached.x + i, cached.y + i, cached.z + i);
    const V path2 = dot(path, path);
    near = hn::And(near, hn::Lt(path2, limit));
    most = hn::Max(most, path2);
  }
  cached.moved_m = traveled_m + 1.001f * std::sqrt(hn::GetLane(hn::MaxOfLanes(f, most)));
  return hn::AllTrue(f, near);
}

/// Index of the ellipsoid in the cache, where it is added if it is new; -1 if there is no room.
HWY_INLINE int slot_of(CachedBatch& cached, std::int32_t ellipsoid) {
  for (int i = 0; i < cached.candidates; ++i)
    if (cached.candidate[i] == ellipsoid) return i;
  if (cached.candidates == CachedBatch::kCapacity) return -1;
  cached.candidate[cached.candidates] = ellipsoid;
  return cached.candidates++;
}

/// Sorts the candidates by index, as in all lists, because blended results are summed in that order.
HWY_INLINE void sort_candidates(CachedBatch& cached) {
  std::int32_t sorted[CachedBatch::kCapacity], from[CachedBatch::kCapacity];
  for (int i = 0; i < cached.candidates; ++i) {
    int rank = 0;
    for (int k = 0; k < cached.candidates; ++k) rank += cached.candidate[k] < cached.candidate[i];
    sorted[rank] = cached.candidate[i];
    from[rank] = i;
  }
  for (float(&slack_m)[CachedBatch::kCapacity] : cached.slack_m) {
    float before_m[CachedBatch::kCapacity];
    std::copy_n(slack_m, CachedBatch::kCapacity, before_m);
    for (int i = 0; i < cached.candidates; ++i) slack_m[i] = before_m[from[i]];
  }
  std::copy_n(sorted, cached.candidates, cached.candidate);
}

/// For one step of particles: every candidate's bound, and per particle the bound above which an ellipsoid is
/// farther than the nearest.
struct StepBounds {
  alignas(64) float bound[kMaxCandidates * kStep];  ///< one step for each candidate
  V limit[kVectorsInStep];
  float least_m;  ///< least bound of all
};

/// A refresh of the cache of one batch.
struct CacheRefresh {
  const Baked& baked;
  const Batch& batch;
  float beyond_m;
  CachedBatch& cached;

  /// How much farther than the nearest a candidate may be to be cached.
  float widest_m() const { return beyond_m + 2.0f * cached.reach_m; }

  Status operator()(const Candidates& among) const {
    return with_tables(among.columns, [&](auto tables) { return cache_candidates<tables()>(among); });
  }

 private:
  template <int kTables>
  HWY_INLINE Status cache_candidates(const Candidates& among) const;
  /// Bounds all candidates at one step of particles and evaluates the probable owners exactly.
  template <int kTables>
  HWY_INLINE void bound_step(int from, const CandidateList& candidates, const Columns& columns,
                             StepBounds& out) const;
  /// Caches the candidates that, at some particle of the step, exceed the nearest distance by less than
  /// widest_m(). False if there is no room. `slot`: a column's index in the cache, or -1.
  template <int kTables>
  HWY_INLINE bool cache_step(int from, const CandidateList& candidates, const Columns& columns,
                             std::int32_t* slot) const;
};

template <int kTables>
HWY_INLINE Status CacheRefresh::cache_candidates(const Candidates& among) const {
  std::int32_t slot[kMaxCandidates];
  std::fill_n(slot, among.columns.count(), -1);
  for (int i = 0; i < among.count; ++i)
    for (int from = among.ranges[i].begin; from < end_of(among.ranges[i]); from += kStep)
      if (!cache_step<kTables>(from, among.lists[i], among.columns, slot)) return Status::kTooMany;
  return Status::kDone;
}

template <int kTables>
HWY_INLINE void CacheRefresh::bound_step(int from, const CandidateList& candidates, const Columns& columns,
                                         StepBounds& out) const {
  V3 p[kVectorsInStep];
  LowestBounds<0> lowest[kVectorsInStep];
  load_step(batch, from, p);
  for (LowestBounds<0>& l : lowest) l.clear();
  for (int i = 0; i < candidates.count; ++i)
    for (int v = 0; v < kVectorsInStep; ++v) {
      const V bound = lower_bound(baked.bounds[columns.ellipsoid(candidates.index[i])], p[v]);
      hn::Store(bound, f, out.bound + i * kStep + v * kWidth);
      lowest[v].add(bound, hn::Set(I(), candidates.index[i]));
    }
  Shape shapes[kVectorsInStep];
  ClosestPointLanes closest[kVectorsInStep];
  for (int v = 0; v < kVectorsInStep; ++v)
    shapes[v] = shape_from(ColumnLanes<kTables>(columns, lowest[v].rank(0)));
  closest_points(shapes, p, closest);
  for (int v = 0; v < kVectorsInStep; ++v) out.limit[v] = bound_limit(baked, closest[v].distance, 0.0f);
  V least = lowest[0].bound[0];
  for (int v = 1; v < kVectorsInStep; ++v) least = hn::Min(least, lowest[v].bound[0]);
  out.least_m = hn::GetLane(hn::MinOfLanes(f, least));
}

template <int kTables>
HWY_INLINE bool CacheRefresh::cache_step(int from, const CandidateList& candidates, const Columns& columns,
                                         std::int32_t* slot) const {
  StepBounds step;
  bound_step<kTables>(from, candidates, columns, step);
  const int span = from / CachedBatch::kSpan;
  cached.least_m[span] = std::min(cached.least_m[span], step.least_m);
  for (int i = 0; i < candidates.count; ++i) {
    V slack = all(CachedBatch::kFar_m);
    for (int v = 0; v < kVectorsInStep; ++v) {
      const V bound = hn::Load(f, step.bound + i * kStep + v * kWidth);
      slack = hn::Min(slack, hn::Max(hn::Sub(bound, step.limit[v]), hn::Zero(f)));
    }
    if (hn::AllTrue(f, hn::Gt(slack, all(widest_m())))) continue;
    const float slack_m = hn::GetLane(hn::MinOfLanes(f, slack));
    const std::int32_t column = candidates.index[i];
    if (slot[column] < 0)
      slot[column] = slot_of(cached, static_cast<std::int32_t>(columns.ellipsoid(column)));
    if (slot[column] < 0) return false;
    float& least_m = cached.slack_m[span][slot[column]];
    least_m = std::min(least_m, slack_m);
  }
  return true;
}

/// Stores the positions and the pose from which displacements count.
HWY_INLINE void cache_positions(const Batch& batch, CachedBatch& cached) {
  for (int i = 0; i < batch.at.count; i += kWidth) {
    hn::Store(hn::LoadU(f, batch.at.x + i), f, cached.x + i);
    hn::Store(hn::LoadU(f, batch.at.y + i), f, cached.y + i);
    hn::Store(hn::LoadU(f, batch.at.z + i), f, cached.z + i);
  }
  cached.traveled_m = batch.cache.traveled_m;
  cached.moved_m = 0.0f;
  cached.count = batch.at.count;
}

/// Fills the cache of a batch; Find is a rule of domination-inl.hpp, made from how much farther than the
/// nearest an ellipsoid still counts. False if the candidates do not fit, or if a particle is too far away
/// for floats.
template <class Find>
bool fill_cache(float beyond_m, Batch& batch, BroadPhase& broad) {
  CachedBatch& cached = *batch.cache.batch;
  const Blocks blocks(batch.at, {0, batch.at.count});
  if (!blocks.in_float_range) return false;
  blocks.note_radii(batch.radius_m);
  cached.candidates = 0;
  std::fill_n(cached.slack_m[0], CachedBatch::kSpans * CachedBatch::kCapacity, CachedBatch::kFar_m);
  std::fill_n(cached.least_m, CachedBatch::kSpans, kNoLimit_m);
  const CacheRefresh refresh{broad.model().baked, batch, beyond_m, cached};
  const Find find{refresh.widest_m()};
  if (broad.search(blocks.ranges, blocks.count, find, refresh) != Status::kDone) return false;
  // With more candidates, gathers would cost more than a new search.
  if (cached.candidates > kPermuted) return false;
  sort_candidates(cached);
  cache_positions(batch, cached);
  return true;
}

/// Makes the cache of a batch valid, if it has one: a stale cache is refreshed if that is likely to pay.
/// False if there is no valid cache.
template <class Find>
HWY_INLINE bool refresh_if_stale(float beyond_m, Batch& batch, BroadPhase& broad) {
  const CacheAccess& cache = batch.cache;
  if (!cache.batch) return false;
  CachedBatch& cached = *cache.batch;
  if (update_displacement(cached, batch)) {
    ++cached.used;
    std::fill_n(batch.radius_m, kBlocks, -1.0f);
    return true;
  }
  if (!cached.begin_refresh(cache.least_reach_m, cache.most_reach_m)) return false;
  if (fill_cache<Find>(beyond_m, batch, broad)) return true;
  cached.give_up();
  return false;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
