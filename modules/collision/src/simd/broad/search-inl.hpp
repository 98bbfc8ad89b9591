// The broad phase of a batch: calls the narrow phase on ranges of lanes with their candidates, from a search
// or from the candidate cache.
#if defined(BODICE_COLLISION_SEARCH_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SEARCH_INL_
#undef BODICE_COLLISION_SEARCH_INL_
#else
#define BODICE_COLLISION_SEARCH_INL_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>

#include "model/candidate_cache.hpp"
#include "model/fallback.hpp"
#include "simd/broad/ranges-inl.hpp"
#include "simd/ellipsoid/bound-inl.hpp"
#include "simd/ellipsoid/columns-inl.hpp"
#include "simd/ellipsoid/shape-inl.hpp"
#include "simd/math/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr int kCorners = 8;  // of a box

/// Source of candidates: the proxy's ellipsoids [begin, end). Groups with boxes too far away are skipped.
struct AllEllipsoids {
  const Baked& baked;
  int begin, end;  ///< begin is the first ellipsoid of a group

  explicit AllEllipsoids(const Baked& b) : AllEllipsoids(b, 0, static_cast<int>(b.size())) {}
  AllEllipsoids(const Baked& b, int first, int last) : baked(b), begin(first), end(last) {}

  /// Distance from the box to the nearest group.
  HWY_INLINE float least_gap(const Aabb& box) const {
    V least = all(1e30f);
    for_groups([&](int group) { least = hn::Min(least, gap(box, group)); });
    return hn::GetLane(hn::MinOfLanes(f, least));
  }
  /// Calls work(index of the first ellipsoid) for each vector of ellipsoids that may come within `within_m`
  /// of the box.
  template <class Work>
  HWY_INLINE void for_vectors(const Aabb& box, float within_m, Work&& work) const {
    const V limit = all(std::max(0.0f, within_m) + baked.rounding_m + rounding_over(box));
    for_groups([&](int group) {
      const std::uint64_t near = bits(hn::Le(gap(box, group), limit));
      for (std::uint64_t left = near; left != 0; left &= left - 1) {
        const int first = (group + std::countr_zero(left)) * kGroup;
        for (int k = first; k < std::min(first + kGroup, end); k += kWidth) work(k);
      }
    });
  }
  HWY_INLINE BallLanes balls(int k) const {
    return ball_lanes([&](int i) { return hn::LoadU(f, baked.cull.ball[i].data() + k); });
  }
  /// The first ellipsoid in as many lanes as a box has corners, the second in the lanes above; a narrow
  /// vector holds the first alone.
  HWY_INLINE Shape shapes(std::int32_t first, std::int32_t second) const {
    const auto one = [&](std::int32_t k) { return broadcast(baked.ellipsoids[static_cast<std::size_t>(k)]); };
    if constexpr (kWidth <= kCorners) return one(first);
    return select(hn::FirstN(f, kCorners), one(first), one(second));
  }

 private:
  template <class Work>
  HWY_INLINE void for_groups(Work&& work) const {
    for (int group = begin / kGroup; group * kGroup < end; group += kWidth) work(group);
  }
  HWY_INLINE V gap(const Aabb& box, int group) const {
    return box_distance(baked.cull.group_low, baked.cull.group_high, box, static_cast<std::size_t>(group));
  }
};

/// Source of candidates: the columns that several blocks share.
template <int kTables>
struct ColumnEllipsoids {
  const Columns& columns;
  int end = columns.count();

  HWY_INLINE float least_gap(const Aabb&) const { return 0.0f; }
  template <class Work>
  HWY_INLINE void for_vectors(const Aabb&, float, Work&& work) const {
    for (int k = 0; k < end; k += kWidth) work(k);
  }
  HWY_INLINE BallLanes balls(int k) const {
    return ball_lanes([&](int i) { return hn::LoadU(f, columns.row(Columns::kBall + i) + k); });
  }
  HWY_INLINE Shape shapes(std::int32_t first, std::int32_t second) const {
    const VI lower = hn::Set(I(), first), upper = hn::Set(I(), second);
    return shape_from(ColumnLanes<kTables>(columns, hn::IfThenElse(hn::FirstN(I(), kCorners), lower, upper)));
  }
};

/// Some ranges of lanes, each with its candidates among the columns that they share.
struct Candidates {
  const Columns& columns;
  const LaneRange* ranges;
  const CandidateList* lists;
  int count;
};

/// Reference to an evaluation of particles among their candidates: a callable (candidates; returns a Status)
/// that lives longer than this. Since its type is erased, a search is compiled once for all evaluations, and
/// an evaluation once for all searches. A call is made once a batch or a block.
class EvaluationRef {
 public:
  template <class Evaluate>
  HWY_INLINE EvaluationRef(const Evaluate& evaluate)
      : evaluate_(&evaluate), call_([](const void* object, const Candidates& among) {
          return (*static_cast<const Evaluate*>(object))(among);
        }) {}

  HWY_INLINE Status operator()(const Candidates& among) const { return call_(evaluate_, among); }

 private:
  const void* evaluate_;
  Status (*call_)(const void*, const Candidates&);
};

/// Finds the candidates of ranges by a rule, and evaluates the particles among them. A rule (source, box
/// around the ranges, ranges, their number, lists out) returns false on overflow; domination-inl.hpp has
/// them.
class BroadPhase {
 public:
  explicit HWY_INLINE BroadPhase(const ProxyModel& model) : model_(model) {}

  const ProxyModel& model() const { return model_; }
  /// Distance by which the boxes of later searches are grown, so that their candidates may serve again,
  /// meters; zero: they do not.
  void reuse_within(float room_m) { room_m_ = room_m; }

  /// `find` is called for all ranges together, then for each range among the candidates found. `evaluate` is
  /// called once if the candidates fit into two vectors of columns, otherwise once a range.
  template <class Find>
  Status search(const LaneRange* ranges, int count, const Find& find, EvaluationRef evaluate);
  /// Evaluates among the candidates of the previous search if they are known to hold for all ranges.
  HWY_INLINE bool search_again(const Blocks& blocks, EvaluationRef evaluate);
  /// One range against any number of plain ellipsoids, as many at a time as there is room for; `find`
  /// (source, list out).
  template <class Find>
  HWY_INLINE void search_in_parts(const LaneRange& range, Find&& find, EvaluationRef evaluate);
  /// Evaluates among the cached candidates of a batch that have less slack than `beyond_m` allows by now.
  /// Spans of lanes that cannot come within `limit_m` of an ellipsoid get no candidates.
  HWY_INLINE Status take_cached(const Batch& batch, float beyond_m, float limit_m, Columns::Rows rows,
                                EvaluationRef evaluate);

 private:
  /// Up to this many shared candidates, each block evaluates all bounds instead of filtering the candidates.
  static constexpr int kFew = kWidth / 2;

  /// Evaluates one range with all columns as candidates.
  HWY_INLINE Status evaluate_range(const LaneRange& range, const Columns& columns, EvaluationRef evaluate);
  /// The ranges share up to two vectors of columns.
  template <class Find>
  HWY_INLINE Status evaluate_together(const Aabb& around, const LaneRange* ranges, int count,
                                      const Find& find, EvaluationRef evaluate);
  template <class Find>
  HWY_INLINE Status evaluate_apart(const Aabb& around, const LaneRange* ranges, int count, const Find& find,
                                   EvaluationRef evaluate);

  const ProxyModel& model_;
  Columns columns_, alone_;
  CandidateList of_all_, of_range_[kBlocks], of_alone_, of_span_[CachedBatch::kSpans];
  float room_m_ = 0.0f;
  Aabb covered_;         ///< box in which the columns hold all candidates
  bool covers_ = false;  ///< whether `covered_` is valid
};

/// Lists every column, for a range that does not share them.
HWY_INLINE void list_every_column(const Columns& columns, CandidateList& out) {
  out.count = columns.count();
  for (int i = 0; i < out.count; i += kWidth) hn::Store(lanes_from(i), I(), out.index + i);
}

HWY_INLINE Status BroadPhase::evaluate_range(const LaneRange& range, const Columns& columns,
                                             EvaluationRef evaluate) {
  list_every_column(columns, of_alone_);
  return evaluate({columns, &range, &of_alone_, 1});
}

template <class Find>
HWY_INLINE Status BroadPhase::evaluate_together(const Aabb& around, const LaneRange* ranges, int count,
                                                const Find& find, EvaluationRef evaluate) {
  if (of_all_.count <= kFew)
    for (int i = 0; i < count; ++i) list_every_column(columns_, of_range_[i]);
  else
    (void)with_tables(columns_, [&](auto tables) {
      return find(ColumnEllipsoids<tables()>{columns_}, around, ranges, count, of_range_);
    });
  return evaluate({columns_, ranges, of_range_, count});
}

template <class Find>
HWY_INLINE Status BroadPhase::evaluate_apart(const Aabb& around, const LaneRange* ranges, int count,
                                             const Find& find, EvaluationRef evaluate) {
  if (!find(ColumnEllipsoids<0>{columns_}, around, ranges, count, of_range_)) return Status::kTooMany;
  for (int i = 0; i < count; ++i) {
    CandidateList& list = of_range_[i];
    if (list.count == 0) continue;
    for (int k = 0; k < list.count; ++k) list.index[k] = of_all_.index[list.index[k]];
    alone_.fill(model_, list.index, list.count);
    const Status status = evaluate_range(ranges[i], alone_, evaluate);
    if (status != Status::kDone) return status;
  }
  return Status::kDone;
}

template <class Find>
Status BroadPhase::search(const LaneRange* ranges, int count, const Find& find, EvaluationRef evaluate) {
  LaneRange around = ranges[0];
  for (int i = 1; i < count; ++i) around.box = united(around.box, ranges[i].box);
  covers_ = false;
  if (room_m_ > 0.0f) around.box = grown(around.box, room_m_);
  if (!find(AllEllipsoids(model_.baked), around.box, &around, 1, &of_all_)) return Status::kTooMany;
  if (of_all_.count == 0) return Status::kDone;
  columns_.fill(model_, of_all_.index, of_all_.count);
  const bool few = of_all_.count <= 2 * kWidth;
  covered_ = around.box;
  covers_ = room_m_ > 0.0f && few;
  if (count == 1) return evaluate_range(ranges[0], columns_, evaluate);
  return few ? evaluate_together(around.box, ranges, count, find, evaluate)
             : evaluate_apart(around.box, ranges, count, find, evaluate);
}

HWY_INLINE bool BroadPhase::search_again(const Blocks& blocks, EvaluationRef evaluate) {
  if (!covers_) return false;
  for (int i = 0; i < blocks.count; ++i)
    if (!contains(covered_, blocks.ranges[i].box)) return false;
  LaneRange all = blocks.ranges[0];
  all.end = blocks.ranges[blocks.count - 1].end;
  return evaluate_range(all, columns_, evaluate) == Status::kDone;
}

template <class Find>
HWY_INLINE void BroadPhase::search_in_parts(const LaneRange& range, Find&& find, EvaluationRef evaluate) {
  constexpr int kPart = kMaxCandidates;
  static_assert(kPart % kGroup == 0);
  const int end = static_cast<int>(model_.baked.size());
  for (int k = 0; k < end; k += kPart) {
    find(AllEllipsoids(model_.baked, k, std::min(k + kPart, end)), of_all_);
    if (of_all_.count == 0) continue;
    columns_.fill(model_, of_all_.index, of_all_.count);
    (void)evaluate_range(range, columns_, evaluate);
  }
}

/// Lists the candidates of a span that may be within `beyond_m` of the nearest by now.
HWY_INLINE void list_cached(const CachedBatch& cached, int span, float beyond_m, CandidateList& out) {
  const V most = all(beyond_m + 2.0f * cached.moved_m);
  out.count = 0;
  for (int first = 0; first < cached.candidates; first += kWidth) {
    const Pack near(hn::Le(hn::Load(f, cached.slack_m[span] + first), most));
    near.store(lanes_from(first), out.index + out.count);
    out.count += near.count();
  }
}

HWY_INLINE Status BroadPhase::take_cached(const Batch& batch, float beyond_m, float limit_m,
                                          Columns::Rows rows, EvaluationRef evaluate) {
  const CachedBatch& cached = *batch.cache.batch;
  columns_.fill(model_, cached.candidate, cached.candidates, rows);
  LaneRange ranges[CachedBatch::kSpans];
  int count = 0;
  for (int begin = 0; begin < batch.at.count; begin += CachedBatch::kSpan, ++count) {
    ranges[count].begin = begin;
    ranges[count].end = std::min(begin + CachedBatch::kSpan, batch.at.count);
    of_span_[count].count = 0;
    if (cached.least_m[count] - cached.moved_m <= limit_m)
      list_cached(cached, count, beyond_m, of_span_[count]);
  }
  return evaluate({columns_, ranges, of_span_, count});
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
