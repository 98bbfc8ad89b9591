// The proxy's exact distance at every particle of a batch. The lowest first-order bound among a particle's
// candidates gives the probable owner. The exact distance to it excludes, for most particles, all other
// candidates. The rest (of plain ellipsoids one particle in five, of blended ones three in four) is collected
// from the whole block, so that it fills vectors again.
#if defined(BODICE_COLLISION_NEAREST_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NEAREST_INL_
#undef BODICE_COLLISION_NEAREST_INL_
#else
#define BODICE_COLLISION_NEAREST_INL_
#endif

#include <algorithm>
#include <limits>

#include "simd/broad/cached_candidates-inl.hpp"
#include "simd/narrow/combine-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(kBlock % (kVectorsInStep * kWidth) == 0);

/// The lowest bounds of the candidates at some vectors of particles.
template <int kLowest>
HWY_INLINE void bound_vectors(const Baked& baked, const Columns& columns, const CandidateList& candidates,
                              const V3 (&p)[kVectorsInStep], LowestBounds<kLowest> (&out)[kVectorsInStep]) {
  for (LowestBounds<kLowest>& lowest : out) lowest.clear();
  for (int i = 0; i < candidates.count; ++i) {
    const BallMap& e = baked.bounds[columns.ellipsoid(candidates.index[i])];
    const VI rank = hn::Set(I(), candidates.index[i]);
    for (int v = 0; v < kVectorsInStep; ++v) out[v].add(lower_bound(e, p[v]), rank);
  }
}

/// Pairs of particles and candidates that remain open after the first evaluation.
struct Open {
  Pairs pairs;
  /// Particles with more candidates below their limit than LowestBounds holds: their lanes, the highest bound
  /// held, and the limit.
  alignas(64) std::int32_t lane[kBatch + 16];
  alignas(64) float highest[kBatch + 16], limit[kBatch + 16];
  int count = 0;

  /// Adds the candidates of rank kFirst and higher in `lowest` that are below the limits, for the lanes `of`.
  template <int kLowest, int kFirst>
  HWY_INLINE void add(M of, const LowestBounds<kLowest>& lowest, V limits, VI lanes) {
    for (int i = kFirst; i < kLowest; ++i)
      pairs.add(hn::AndNot(hn::Gt(lowest.bound[i], limits), of), lanes, lowest.rank(i));
    const M overflowing = hn::AndNot(hn::Gt(lowest.bound[kLowest], limits), of);
    const Pack pack(overflowing);
    pack.store(lanes, lane + count);
    pack.store(lowest.bound[kLowest - 1], highest + count);
    pack.store(limits, limit + count);
    count += pack.count();
  }
};

/// Evaluates the collected pairs; for plain ellipsoids it also combines the results and empties the list.
template <int kTables>
void flush(const ReliefTables* relief, const Columns& columns, const QueryBatch& batch, Pairs& pairs,
           BatchResults& out) {
  evaluate_pairs<kTables>(relief, columns, batch, pairs);
  if (relief) return;
  combine_nearest(pairs, out);
  pairs.count = 0;
}

/// Makes room for the pairs of so many vectors. False if there is none with relief, since the results to be
/// blended must be in the list together.
template <int kTables>
HWY_INLINE bool make_room(int vectors, const ReliefTables* relief, const Columns& columns,
                          const QueryBatch& batch, Pairs& pairs, BatchResults& out) {
  if (pairs.fit(vectors)) return true;
  if (relief) return false;
  flush<kTables>(nullptr, columns, batch, pairs, out);
  return true;
}

/// Candidates that one pass over the columns takes.
constexpr int kPerPass = 4;

/// One vector of particles with more candidates below their limits than LowestBounds holds.
struct ManyCandidates {
  M lanes;
  VI lane;
  V3 p;
  V highest, limit;
};

/// Adds all their other candidates below the limits.
template <int kTables>
HWY_INLINE void collect_others(const Baked& baked, const Columns& columns, const QueryBatch& batch,
                               const ManyCandidates& many, Pairs& pairs, BatchResults& out) {
  for (int i = 0; i < columns.count(); ++i) {
    (void)make_room<kTables>(1, nullptr, columns, batch, pairs, out);
    const VI rank = hn::Set(I(), i);
    const V bound = ranked(lower_bound(baked.bounds[columns.ellipsoid(i)], many.p), rank);
    const M open = hn::AndNot(hn::Gt(bound, many.limit), hn::Gt(bound, many.highest));
    pairs.add(hn::And(many.lanes, open), many.lane, rank);
  }
}

/// Adds their other candidates by rising bound, because blended results are summed in an order that other
/// candidates must not change. False on overflow.
template <int kTables>
HWY_INLINE bool collect_others_by_bound(const Baked& baked, const ReliefTables& relief,
                                        const Columns& columns, const QueryBatch& batch, ManyCandidates& many,
                                        Pairs& pairs, BatchResults& out) {
  M& more = many.lanes;
  for (int taken = 0; taken < columns.count() && !hn::AllFalse(f, more); taken += kPerPass) {
    LowestBounds<kPerPass> next;
    next.clear();
    for (int i = 0; i < columns.count(); ++i) {
      const VI rank = hn::Set(I(), i);
      const V bound = ranked(lower_bound(baked.bounds[columns.ellipsoid(i)], many.p), rank);
      next.add(hn::IfThenElse(hn::Gt(bound, many.highest), bound, all(1e29f)), rank);
    }
    if (!make_room<kTables>(kPerPass, &relief, columns, batch, pairs, out)) return false;
    for (int i = 0; i < kPerPass; ++i)
      pairs.add(hn::AndNot(hn::Gt(next.bound[i], many.limit), more), many.lane, next.rank(i));
    more = hn::AndNot(hn::Gt(next.bound[kPerPass], many.limit), more);
    many.highest = next.bound[kPerPass - 1];
  }
  return true;
}

/// Adds the pairs of the particles with many candidates; false on overflow.
template <int kTables>
HWY_INLINE bool collect_rest(const Baked& baked, const ReliefTables* relief, const Columns& columns,
                             const QueryBatch& batch, Open& open, BatchResults& out) {
  for (int from = 0; from < open.count; from += kWidth) {
    ManyCandidates many;
    many.lanes = hn::FirstN(f, static_cast<std::size_t>(open.count - from));
    many.lane = hn::IfThenElseZero(hn::RebindMask(I(), many.lanes), hn::Load(I(), open.lane + from));
    many.p = {hn::GatherIndex(f, batch.x, many.lane), hn::GatherIndex(f, batch.y, many.lane),
              hn::GatherIndex(f, batch.z, many.lane)};
    many.highest = hn::Load(f, open.highest + from);
    many.limit = hn::Load(f, open.limit + from);
    if (!relief)
      collect_others<kTables>(baked, columns, batch, many, open.pairs, out);
    else if (!collect_others_by_bound<kTables>(baked, *relief, columns, batch, many, open.pairs, out))
      return false;
  }
  return true;
}

/// Evaluates the probable owners of the particles of one range. False on overflow of the pairs that remain
/// open.
template <int kLowest, int kTables>
HWY_INLINE bool evaluate_first(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                               const LaneRange& range, const CandidateList& candidates,
                               const Columns& columns, Open& open, BatchResults& out) {
  const float beyond_m = relief ? relief->blend_m : 0.0f;
  for (int from = range.begin; from < end_of(range); from += kStep) {
    V3 p[kVectorsInStep];
    LowestBounds<kLowest> lowest[kVectorsInStep];
    VI first[kVectorsInStep];
    Result results[kVectorsInStep];
    load_step(batch, from, p);
    bound_vectors(baked, columns, candidates, p, lowest);
    for (int v = 0; v < kVectorsInStep; ++v) first[v] = lowest[v].rank(0);
    evaluate_each<kTables>(relief, columns, first, p, results);
    if (!make_room<kTables>((kLowest - 1) * kVectorsInStep, relief, columns, batch, open.pairs, out))
      return false;
    for (int v = 0; v < kVectorsInStep; ++v) {
      const int i = from + v * kWidth;
      put(results[v], relief != nullptr, out, i);
      open.add<kLowest, 1>(lanes_below(i, range.end), lowest[v],
                           bound_limit(baked, results[v].distance, beyond_m), lanes_from(i));
    }
  }
  return true;
}

/// Evaluates a range with a single candidate: nothing is chosen, and all lanes have the same shape.
inline void evaluate_single_candidate(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                                      const LaneRange& range, std::size_t ellipsoid, BatchResults& out) {
  const Shape shape = broadcast(baked.ellipsoids[ellipsoid]);
  const VI proxy_index = hn::Set(I(), baked.proxy_index[ellipsoid]);
  Shape shapes[kVectorsInStep];
  std::fill_n(shapes, kVectorsInStep, shape);
  for (int from = range.begin; from < end_of(range); from += kStep) {
    V3 p[kVectorsInStep];
    ClosestPointLanes closest[kVectorsInStep];
    load_step(batch, from, p);
    closest_points(shapes, p, closest);
    for (int v = 0; v < kVectorsInStep; ++v) {
      Result result = {closest[v].distance, closest[v].distance, {}, proxy_index};
      if (relief) {
        const BakedTable& table = relief->tables[ellipsoid];
        const Corrected one =
            corrected(*relief, broadcast(table), shape, closest[v], [&] { return axes_of(table); });
        result.value = one.value;
        result.gradient = one.gradient;
      } else {
        result.gradient = normal_of(shape, closest[v]);
      }
      put(result, relief != nullptr, out, from + v * kWidth);
    }
  }
}

/// Evaluates some ranges of the batch with the columns as candidates.
template <int kLowest, int kTables>
HWY_INLINE bool evaluate_ranges(const Baked& baked, const ReliefTables* relief, const QueryBatch& batch,
                                const LaneRange* ranges, int count, const CandidateList* candidates,
                                const Columns& columns, Open& open, BatchResults& out) {
  open.pairs.count = open.count = 0;
  for (int i = 0; i < count; ++i) {
    if (candidates[i].count == 1)
      evaluate_single_candidate(baked, relief, batch, ranges[i], columns.ellipsoid(candidates[i].index[0]),
                                out);
    else if (!evaluate_first<kLowest, kTables>(baked, relief, batch, ranges[i], candidates[i], columns, open,
                                               out))
      return false;
  }
  if (!collect_rest<kTables>(baked, relief, columns, batch, open, out)) return false;
  flush<kTables>(relief, columns, batch, open.pairs, out);
  if (relief) combine_blended(*relief, ranges[0].begin, end_of(ranges[count - 1]), open.pairs, out);
  return true;
}

/// Buffers of one call, on the stack.
struct Scratch {
  BroadPhaseLists lists;
  Open open;
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

/// Evaluates a range against plain ellipsoids when they are more than the lists hold.
template <class Work>
HWY_INLINE void nearest_in_parts(const Baked& baked, const LaneRange& range, float beyond_m, Scratch& scratch,
                                 Work&& work, BatchResults& out) {
  Dominators dominators;
  find_dominators(AllEllipsoids(baked), range.box, &range, 1, &dominators);
  measure_corners(AllEllipsoids(baked), &range, 1, &dominators);
  BatchResults part;
  std::fill(out.distance + range.begin, out.distance + range.end, std::numeric_limits<float>::infinity());
  const auto find = [&](const AllEllipsoids& source, CandidateList* list) {
    (void)collect_not_dominated<false>(source, range.box, &range, 1, &dominators, beyond_m, kNoLimit_m, list);
  };
  in_parts(baked, range, scratch.lists, find,
           [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
               const CandidateList* lists) {
             (void)work(tables, columns, ranges, count, lists, part);
             take_nearer(range, part, out);
             return true;
           });
}

/// With relief, evaluates each particle of the range by itself: `work` (batch, ranges, their number, results
/// out). False on overflow even then.
template <class Work>
HWY_INLINE bool one_by_one(const QueryBatch& batch, const LaneRange& range, Work&& work, BatchResults& out) {
  alignas(64) float x[kStep], y[kStep], z[kStep];
  BatchResults alone;
  for (int i = range.begin; i < range.end; ++i) {
    std::fill(x, x + kStep, batch.x[i]);
    std::fill(y, y + kStep, batch.y[i]);
    std::fill(z, z + kStep, batch.z[i]);
    const QueryBatch one = batch_at(x, y, z, 1);
    bool in_float_range = false;
    const LaneRange lane = range_of(one, 0, 1, in_float_range);
    if (!work(one, &lane, 1, alone)) return false;
    out.distance[i] = alone.distance[0];
    out.value[i] = alone.value[0];
    out.gx[i] = alone.gx[0];
    out.gy[i] = alone.gy[0];
    out.gz[i] = alone.gz[0];
    out.proxy_index[i] = alone.proxy_index[0];
  }
  return true;
}

/// Distance, unit gradient and owner of every particle. False if a particle is too far away for floats, or if
/// more ellipsoids with relief are near one than the lists hold.
inline bool nearest(const Baked& baked, const ReliefTables* relief, QueryBatch& batch, Scratch& scratch,
                    BatchResults& out) {
  const float beyond_m = (relief ? relief->blend_m : 0.0f) + 4.0f * baked.rounding_m;
  const auto find = [&](const auto& source, const Aabb& around, const LaneRange* ranges, int count,
                        CandidateList* lists) {
    return find_candidates<false>(source, around, ranges, count, beyond_m, kNoLimit_m, lists);
  };
  const auto evaluate = [&](auto tables, const QueryBatch& of, const Columns& columns,
                            const LaneRange* ranges, int count, const CandidateList* lists,
                            BatchResults& to) {
    Open& open = scratch.open;
    if (relief)
      return evaluate_ranges<3, tables()>(baked, relief, of, ranges, count, lists, columns, open, to);
    return evaluate_ranges<2, tables()>(baked, nullptr, of, ranges, count, lists, columns, open, to);
  };
  const auto among_candidates = [&](const QueryBatch& of, const LaneRange* ranges, int count,
                                    BatchResults& to) {
    const auto work = [&](auto tables, const Columns& columns, const LaneRange* some, int number,
                          const CandidateList* lists) {
      return evaluate(tables, of, columns, some, number, lists, to);
    };
    return with_candidates(baked, relief, ranges, count, scratch.lists, find, work);
  };
  const auto in_part = [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
                           const CandidateList* lists, BatchResults& to) {
    return evaluate(tables, batch, columns, ranges, count, lists, to);
  };
  if (use_cache(baked, relief, beyond_m, batch, scratch.lists) &&
      with_cached_candidates(baked, relief, batch, beyond_m, kNoLimit_m, Columns::Rows::kShapes,
                             scratch.lists,
                             [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
                                 const CandidateList* lists) {
                               return evaluate(tables, batch, columns, ranges, count, lists, out);
                             }))
    return true;
  const Blocks blocks(batch);
  if (!blocks.in_float_range) return false;
  for (int i = 0; i < blocks.count; ++i) batch.radius_m[i] = blocks.ranges[i].box.radius;
  if (with_previous_candidates(blocks.ranges, blocks.count, scratch.lists,
                               [&](auto tables, const Columns& columns, const LaneRange* ranges, int count,
                                   const CandidateList* lists) {
                                 return evaluate(tables, batch, columns, ranges, count, lists, out);
                               }))
    return true;
  return with_fallback(
      batch, blocks,
      [&](const LaneRange* ranges, int count) { return among_candidates(batch, ranges, count, out); },
      [&](const LaneRange& range) {
        if (relief) return one_by_one(batch, range, among_candidates, out);
        nearest_in_parts(baked, range, beyond_m, scratch, in_part, out);
        return true;
      });
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
