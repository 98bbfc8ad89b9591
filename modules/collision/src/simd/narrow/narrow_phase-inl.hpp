// The narrow phase: the lowest first-order bound among a particle's candidates gives the probable owner. The
// exact distance to it excludes, for most particles, all other candidates. The rest (of plain ellipsoids one
// particle in five, of blended ones three in four) is collected from the whole batch, so that it fills
// vectors again.
#if defined(BODICE_COLLISION_NARROW_PHASE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NARROW_PHASE_INL_
#undef BODICE_COLLISION_NARROW_PHASE_INL_
#else
#define BODICE_COLLISION_NARROW_PHASE_INL_
#endif

#include <algorithm>
#include <cstddef>

#include "simd/broad/search-inl.hpp"
#include "simd/ellipsoid/closest_point-inl.hpp"
#include "simd/narrow/combine-inl.hpp"
#include "simd/narrow/pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// Pairs of particles and candidates that remain open after the first evaluation.
struct Open {
  Pairs pairs;
  /// Particles with more candidates below their limit than LowestBounds holds: their lanes, the highest bound
  /// held, and the limit.
  alignas(64) std::int32_t lane[kBatch + 16];
  alignas(64) float highest[kBatch + 16], limit[kBatch + 16];
  int count = 0;

  void clear() { pairs.count = count = 0; }
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

/// Evaluates particles among their candidates: first the probable owner of each, then the pairs that remain
/// open. Union is a policy of unions-inl.hpp.
template <class Union>
class NarrowPhase {
 public:
  static constexpr int kLowest = Union::kLowest;
  using Lowest = LowestBounds<kLowest>;

  HWY_INLINE NarrowPhase(const Union& proxy, const Batch& batch, Open& open, BatchResults& out)
      : proxy_(proxy), batch_(batch), open_(open), out_(out) {}

  const Batch& batch() const { return batch_; }
  const Baked& baked() const { return proxy_.model.baked; }
  void start() { open_.clear(); }
  /// The lowest bounds of the candidates at one step of particles.
  HWY_INLINE void bound_step(const Columns& columns, const CandidateList& candidates,
                             const V3 (&p)[kVectorsInStep], Lowest (&out)[kVectorsInStep]) const;
  /// Evaluates the probable owners of one step of particles; results begin at lane `from`. `step` has
  /// the bounds of vector v, its lanes, and the least of a distance and the vector's limit. False on
  /// overflow.
  template <int kTables, class Step>
  HWY_INLINE bool evaluate_owners(const Columns& columns, int from, const V3 (&p)[kVectorsInStep],
                                  const Step& step);
  /// Evaluates a range with a single candidate: nothing is chosen, and all lanes have the same shape.
  void evaluate_single(const LaneRange& range, std::size_t ellipsoid);
  /// Makes room for the pairs of so many vectors. False if there is none and results are blended, since these
  /// must be in the list together.
  template <int kTables>
  HWY_INLINE bool make_room(const Columns& columns, int vectors);
  /// Evaluates what remains open and combines the results of the lanes; kTooMany on overflow.
  template <int kTables>
  HWY_INLINE Status finish(const Columns& columns, LaneSpan lanes);

 private:
  /// One vector of particles with more candidates below their limits than LowestBounds holds.
  struct ManyCandidates {
    M lanes;
    VI lane;
    V3 p;
    V highest, limit;
  };
  static constexpr int kPerPass = 4;  ///< candidates that one pass over the columns takes

  /// Evaluates several vectors side by side.
  template <int kTables>
  HWY_INLINE void evaluate_each(const Columns& columns, const VI (&column)[kVectorsInStep],
                                const V3 (&p)[kVectorsInStep], Result (&out)[kVectorsInStep]) const;
  template <int kTables>
  HWY_INLINE void evaluate_pairs(const Columns& columns);
  /// Evaluates the collected pairs; unless results are blended, it also combines them and empties the list.
  template <int kTables>
  void flush(const Columns& columns);
  /// Adds the pairs of the particles with many candidates; false on overflow.
  template <int kTables>
  HWY_INLINE bool collect_rest(const Columns& columns);
  /// Adds all their other candidates below the limits.
  template <int kTables>
  HWY_INLINE void collect_others(const Columns& columns, const ManyCandidates& many);
  /// Adds their other candidates by rising bound, because blended results are summed in an order that other
  /// candidates must not change. False on overflow.
  template <int kTables>
  HWY_INLINE bool collect_others_by_bound(const Columns& columns, ManyCandidates& many);

  const Union& proxy_;
  const Batch& batch_;
  Open& open_;
  BatchResults& out_;
};

template <class Union>
HWY_INLINE void NarrowPhase<Union>::bound_step(const Columns& columns, const CandidateList& candidates,
                                               const V3 (&p)[kVectorsInStep],
                                               Lowest (&out)[kVectorsInStep]) const {
  for (Lowest& lowest : out) lowest.clear();
  for (int i = 0; i < candidates.count; ++i) {
    const BallMap& e = baked().bounds[columns.ellipsoid(candidates.index[i])];
    const VI rank = hn::Set(I(), candidates.index[i]);
    for (int v = 0; v < kVectorsInStep; ++v) out[v].add(lower_bound(e, p[v]), rank);
  }
}

template <class Union>
template <int kTables>
HWY_INLINE void NarrowPhase<Union>::evaluate_each(const Columns& columns, const VI (&column)[kVectorsInStep],
                                                  const V3 (&p)[kVectorsInStep],
                                                  Result (&out)[kVectorsInStep]) const {
  Shape shape[kVectorsInStep];
  ClosestPointLanes closest[kVectorsInStep];
  for (int v = 0; v < kVectorsInStep; ++v) shape[v] = shape_from(ColumnLanes<kTables>(columns, column[v]));
  closest_points(shape, p, closest);
  for (int v = 0; v < kVectorsInStep; ++v)
    out[v] = proxy_.template result<kTables>(columns, column[v], shape[v], closest[v]);
}

template <class Union>
template <int kTables>
HWY_INLINE void NarrowPhase<Union>::evaluate_pairs(const Columns& columns) {
  Pairs& pairs = open_.pairs;
  if (pairs.count == 0) return;
  // The last vectors are filled up with valid pairs.
  for (int v = 0; v < kVectorsInStep; ++v) {
    hn::StoreU(hn::Set(I(), pairs.lane[0]), I(), pairs.lane + pairs.count + v * kWidth);
    hn::StoreU(hn::Zero(I()), I(), pairs.column + pairs.count + v * kWidth);
  }
  for (int from = 0; from < pairs.count; from += kStep) {
    VI column[kVectorsInStep];
    V3 p[kVectorsInStep];
    Result results[kVectorsInStep];
    for (int v = 0; v < kVectorsInStep; ++v) {
      const VI lane = hn::Load(I(), pairs.lane + from + v * kWidth);
      column[v] = hn::Load(I(), pairs.column + from + v * kWidth);
      p[v] = gather3(batch_.at.x, batch_.at.y, batch_.at.z, lane);
    }
    evaluate_each<kTables>(columns, column, p, results);
    for (int v = 0; v < kVectorsInStep; ++v) put<Union>(results[v], pairs.results, from + v * kWidth);
  }
}

template <class Union>
template <int kTables>
void NarrowPhase<Union>::flush(const Columns& columns) {
  evaluate_pairs<kTables>(columns);
  if constexpr (!Union::kBlends) {
    combine_nearest(open_.pairs, out_);
    open_.pairs.count = 0;
  }
}

template <class Union>
template <int kTables>
HWY_INLINE bool NarrowPhase<Union>::make_room(const Columns& columns, int vectors) {
  if (open_.pairs.fit(vectors)) return true;
  if constexpr (Union::kBlends) return false;
  flush<kTables>(columns);
  return true;
}

template <class Union>
template <int kTables>
HWY_INLINE void NarrowPhase<Union>::collect_others(const Columns& columns, const ManyCandidates& many) {
  for (int i = 0; i < columns.count(); ++i) {
    (void)make_room<kTables>(columns, 1);
    const VI rank = hn::Set(I(), i);
    const V bound = ranked(lower_bound(baked().bounds[columns.ellipsoid(i)], many.p), rank);
    const M open = hn::AndNot(hn::Gt(bound, many.limit), hn::Gt(bound, many.highest));
    open_.pairs.add(hn::And(many.lanes, open), many.lane, rank);
  }
}

template <class Union>
template <int kTables>
HWY_INLINE bool NarrowPhase<Union>::collect_others_by_bound(const Columns& columns, ManyCandidates& many) {
  M& more = many.lanes;
  for (int taken = 0; taken < columns.count() && !hn::AllFalse(f, more); taken += kPerPass) {
    LowestBounds<kPerPass> next;
    next.clear();
    for (int i = 0; i < columns.count(); ++i) {
      const VI rank = hn::Set(I(), i);
      const V bound = ranked(lower_bound(baked().bounds[columns.ellipsoid(i)], many.p), rank);
      next.add(hn::IfThenElse(hn::Gt(bound, many.highest), bound, all(1e29f)), rank);
    }
    if (!make_room<kTables>(columns, kPerPass)) return false;
    for (int i = 0; i < kPerPass; ++i)
      open_.pairs.add(hn::AndNot(hn::Gt(next.bound[i], many.limit), more), many.lane, next.rank(i));
    more = hn::AndNot(hn::Gt(next.bound[kPerPass], many.limit), more);
    many.highest = next.bound[kPerPass - 1];
  }
  return true;
}

template <class Union>
template <int kTables>
HWY_INLINE bool NarrowPhase<Union>::collect_rest(const Columns& columns) {
  for (int from = 0; from < open_.count; from += kWidth) {
    ManyCandidates many;
    many.lanes = lanes_below(from, open_.count);
    many.lane = hn::IfThenElseZero(hn::RebindMask(I(), many.lanes), hn::Load(I(), open_.lane + from));
    many.p = gather3(batch_.at.x, batch_.at.y, batch_.at.z, many.lane);
    many.highest = hn::Load(f, open_.highest + from);
    many.limit = hn::Load(f, open_.limit + from);
    if constexpr (!Union::kBlends)
      collect_others<kTables>(columns, many);
    else if (!collect_others_by_bound<kTables>(columns, many))
      return false;
  }
  return true;
}

template <class Union>
template <int kTables, class Step>
HWY_INLINE bool NarrowPhase<Union>::evaluate_owners(const Columns& columns, int from,
                                                    const V3 (&p)[kVectorsInStep], const Step& step) {
  VI first[kVectorsInStep];
  Result results[kVectorsInStep];
  for (int v = 0; v < kVectorsInStep; ++v) first[v] = step.lowest(v).rank(0);
  evaluate_each<kTables>(columns, first, p, results);
  if (!make_room<kTables>(columns, (kLowest - 1) * kVectorsInStep)) return false;
  for (int v = 0; v < kVectorsInStep; ++v) {
    const int i = from + v * kWidth;
    put<Union>(results[v], out_, i);
    const V limit = bound_limit(baked(), step.least(v, results[v].distance), proxy_.model.blend_m());
    open_.add<kLowest, 1>(step.lanes(v), step.lowest(v), limit, lanes_from(i));
  }
  return true;
}

template <class Union>
void NarrowPhase<Union>::evaluate_single(const LaneRange& range, std::size_t ellipsoid) {
  Shape shapes[kVectorsInStep];
  std::fill_n(shapes, kVectorsInStep, broadcast(baked().ellipsoids[ellipsoid]));
  for (int from = range.begin; from < end_of(range); from += kStep) {
    V3 p[kVectorsInStep];
    ClosestPointLanes closest[kVectorsInStep];
    load_step(batch_, from, p);
    closest_points(shapes, p, closest);
    for (int v = 0; v < kVectorsInStep; ++v)
      put<Union>(proxy_.result_of_one(ellipsoid, shapes[v], closest[v]), out_, from + v * kWidth);
  }
}

template <class Union>
template <int kTables>
HWY_INLINE Status NarrowPhase<Union>::finish(const Columns& columns, LaneSpan lanes) {
  if (!collect_rest<kTables>(columns)) return Status::kTooMany;
  flush<kTables>(columns);
  if constexpr (Union::kBlends) combine_blended<Union::kBuries>(proxy_.model, lanes, open_.pairs, out_);
  return Status::kDone;
}

/// What the evaluations of one batch share: the proxy by its policy, the broad phase, and what remains open.
/// Its lists are large and are left uninitialized.
template <class Union>
struct Kernel {
  explicit HWY_INLINE Kernel(const Union& policy) : proxy(policy), broad(policy.model) {}

  const ProxyModel& model() const { return proxy.model; }
  /// How much farther than the nearest an ellipsoid may seem and still count.
  float beyond_m() const { return model().beyond_m() + 4.0f * model().baked.rounding_m; }

  const Union proxy;
  BroadPhase broad;
  Open open;
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
