// The candidates of boxes: ellipsoids that no other ellipsoid dominates. The distance d_j is convex, and the
// tangent plane of another ellipsoid k lies below d_k. Hence d_j minus the plane is convex and largest at a
// corner of the box. If d_j is less than the plane at all eight corners, j dominates k: it is nearer
// everywhere in the box.
#if defined(BODICE_COLLISION_DOMINATION_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_DOMINATION_INL_
#undef BODICE_COLLISION_DOMINATION_INL_
#else
#define BODICE_COLLISION_DOMINATION_INL_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "simd/broad/tangent_candidates-inl.hpp"
#include "simd/ellipsoid/columns-inl.hpp"
#include "simd/math/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kBlocks = kBatch / kBlock;
constexpr int kCorners = 8, kDominators = 2;
constexpr float kNoLimit_m = 1e30f;
static_assert(kDominators * kCorners % kWidth == 0);
static_assert(kGroup % kWidth == 0);

/// Consecutive lanes of a batch and their AABB.
struct LaneRange {
  Aabb box;
  int begin, end;
};

/// Indices of candidates, rising; whole vectors are written behind the last.
struct CandidateList {
  int count = 0;
  alignas(64) std::int32_t index[kMaxCandidates + 16];
};

/// The numbers of BallMap, a different ellipsoid in each lane.
struct BallLanes {
  V3 a0, a1, a2, offset, inverse_radius;
};

/// `row` reads the members of BallMap by their index.
template <class Row>
HWY_INLINE BallLanes ball_lanes(Row&& row) {
  const auto row3 = [&](int i) { return V3{row(i), row(i + 1), row(i + 2)}; };
  return {row3(0), row3(3), row3(6), row3(kBallOffset), row3(kBallInverse)};
}

/// The points p in the frames in which the ellipsoids are unit balls.
HWY_INLINE V3 in_ball(const BallLanes& e, V3 p) {
  const auto row = [&](V3 a, V offset) {
    return hn::MulAdd(a.x, p.x, hn::MulAdd(a.y, p.y, hn::MulAdd(a.z, p.z, offset)));
  };
  return {row(e.a0, e.offset.x), row(e.a1, e.offset.y), row(e.a2, e.offset.z)};
}

/// rounding_over() the box of each range.
struct RangeRounding {
  float m[kBlocks];

  HWY_INLINE RangeRounding(const LaneRange* ranges, int count) {
    for (int i = 0; i < count; ++i) m[i] = rounding_over(ranges[i].box);
  }
};

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
    return shape_of<kTables>(columns, hn::IfThenElse(hn::FirstN(I(), kCorners), lower, upper));
  }
};

/// Planes that bound the distances to ellipsoids k + lane from below: base + slope . (p - middle). The base
/// is the first-order distance at the middle; it is NaN at a center, where there is no bound.
struct BoundPlanes {
  V base, scale;
  V3 u;
};

HWY_INLINE BoundPlanes planes_at(const BallLanes& e, V3 middle) {
  const V3 u = in_ball(e, middle);
  const V3 v = {hn::Mul(u.x, e.inverse_radius.x), hn::Mul(u.y, e.inverse_radius.y),
                hn::Mul(u.z, e.inverse_radius.z)};
  const V square = dot(u, u), scale = inverse_sqrt(dot(v, v));
  return {hn::Mul(hn::NegMulAdd(square, inverse_sqrt(square), square), scale), scale, u};
}

HWY_INLINE V3 slope_of(const BallLanes& e, const BoundPlanes& at) {
  return scaled(add_scaled(add_scaled(scaled(e.a0, at.u.x), at.u.y, e.a1), at.u.z, e.a2), at.scale);
}

/// The two ellipsoids that are probably nearest to a box, and their exact distances at its corners.
struct Dominators {
  std::int32_t index[kDominators];
  alignas(64) float distance[kDominators * kCorners];
};

/// In each lane the ellipsoid of least distance to the middle among those seen in this lane.
struct LeastPerLane {
  V distance;
  VI index;
};

/// The nearest ellipsoid of all lanes, and the nearest of the other lanes, which is good enough for the
/// second.
HWY_INLINE void pick_dominators(LeastPerLane least, Dominators& out) {
  alignas(64) std::int32_t index[kWidth];
  hn::Store(least.index, I(), index);
  for (std::int32_t& dominator : out.index) {
    const V lowest = hn::MinOfLanes(f, least.distance);
    const M which = hn::Eq(least.distance, lowest);
    const auto lane = hn::FindFirstTrue(f, which);
    dominator = index[lane < 0 ? 0 : lane];
    least.distance = hn::IfThenElse(which, all(1e30f), least.distance);
  }
}

/// The two probably nearest ellipsoids of each range's box; `around` contains all boxes.
template <class Source>
HWY_INLINE void find_dominators(const Source& source, const Aabb& around, const LaneRange* ranges, int count,
                                Dominators* out) {
  LeastPerLane least[kBlocks];
  for (LeastPerLane& l : least) l = {all(1e30f), hn::Zero(I())};
  const VI end = hn::Set(I(), source.end);
  source.for_vectors(around, source.least_gap(around), [&](int k) {
    const BallLanes lanes = source.balls(k);
    const VI index = lanes_from(k);
    const M real = hn::RebindMask(f, hn::Lt(index, end));
    for (int i = 0; i < count; ++i) {
      const V distance = planes_at(lanes, broadcast3(ranges[i].box.middle)).base;
      const M nearer = hn::And(real, hn::Lt(distance, least[i].distance));
      least[i].distance = hn::IfThenElse(nearer, distance, least[i].distance);
      least[i].index = hn::IfThenElse(hn::RebindMask(I(), nearer), index, least[i].index);
    }
  });
  for (int i = 0; i < count; ++i) pick_dominators(least[i], out[i]);
}

/// Corners [i, i + kWidth) of the box, repeated for each of the two ellipsoids.
HWY_INLINE V3 corners(const Aabb& e, int i) {
  alignas(64) static constexpr float kSide[3][kDominators * kCorners] = {
      {-1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1},
      {-1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1},
      {-1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, 1, 1, 1, 1}};
  const V3 middle = broadcast3(e.middle), half = broadcast3(e.half);
  return {hn::MulAdd(half.x, hn::Load(f, kSide[0] + i), middle.x),
          hn::MulAdd(half.y, hn::Load(f, kSide[1] + i), middle.y),
          hn::MulAdd(half.z, hn::Load(f, kSide[2] + i), middle.z)};
}

/// Sets the exact distances of the two ellipsoids at the corners of each box.
template <class Source>
HWY_INLINE void measure_corners(const Source& source, const LaneRange* ranges, int count,
                                Dominators* dominators) {
  constexpr int kEach = kDominators * kCorners / kWidth;
  const int vectors = count * kEach;
  for (int from = 0; from < vectors; from += kVectorsInStep) {
    Shape shapes[kVectorsInStep];
    V3 points[kVectorsInStep];
    ClosestPointLanes closest[kVectorsInStep];
    float* to[kVectorsInStep];
    for (int v = 0; v < kVectorsInStep; ++v) {
      const int which = std::min(from + v, vectors - 1), range = which / kEach;
      const int i = which % kEach * kWidth;
      const std::int32_t* const index = dominators[range].index;
      shapes[v] = source.shapes(index[i / kCorners], index[kDominators - 1]);
      points[v] = corners(ranges[range].box, i);
      to[v] = dominators[range].distance + i;
    }
    closest_points(shapes, points, closest);
    for (int v = 0; v < kVectorsInStep; ++v) hn::Store(closest[v].distance, f, to[v]);
  }
}

/// Largest distance to the first of the two ellipsoids at any corner; by convexity it is nowhere farther in
/// the boxes.
HWY_INLINE float farthest_corner_m(const Dominators* dominators, int count) {
  float most = -1e30f;
  for (int i = 0; i < count; ++i)
    for (int corner = 0; corner < kCorners; ++corner) most = std::max(most, dominators[i].distance[corner]);
  return most;
}

/// Ellipsoids that neither of the two dominates by more than `beyond`.
HWY_INLINE M not_dominated(const BoundPlanes& at, V3 slope, V3 half, const Dominators& dominators, V beyond) {
  const V3 reach = {hn::Mul(slope.x, half.x), hn::Mul(slope.y, half.y), hn::Mul(slope.z, half.z)};
  const V x[2] = {hn::Sub(at.base, reach.x), hn::Add(at.base, reach.x)};
  V lead[kDominators] = {all(1e30f), all(1e30f)};
  for (int corner = 0; corner < kCorners; ++corner) {
    const V xy = corner & 2 ? hn::Add(x[corner & 1], reach.y) : hn::Sub(x[corner & 1], reach.y);
    const V plane = corner & 4 ? hn::Add(xy, reach.z) : hn::Sub(xy, reach.z);
    for (int r = 0; r < kDominators; ++r)
      lead[r] = hn::Min(lead[r], hn::Sub(plane, all(dominators.distance[r * kCorners + corner])));
  }
  return hn::Not(hn::And(hn::Gt(hn::Max(lead[0], lead[1]), beyond), hn::Eq(at.base, at.base)));
}

/// Lists for each range, by rising index, the ellipsoids of the source within `within_m` of `around` that
/// keep(bounds, planes at the middle, range) accepts. False if there are more than kMaxCandidates.
template <class Source, class Keep>
HWY_INLINE bool collect_candidates(const Source& source, const Aabb& around, float within_m,
                                   const LaneRange* ranges, int count, CandidateList* out, Keep&& keep) {
  for (int i = 0; i < count; ++i) out[i].count = 0;
  const VI end = hn::Set(I(), source.end);
  bool fits = true;
  source.for_vectors(around, within_m, [&](int k) {
    const BallLanes lanes = source.balls(k);
    const VI index = lanes_from(k);
    const M real = hn::RebindMask(f, hn::Lt(index, end));
    for (int i = 0; i < count; ++i) {
      CandidateList& to = out[i];
      const M chosen = hn::And(real, keep(lanes, planes_at(lanes, broadcast3(ranges[i].box.middle)), i));
      const Pack pack(chosen);
      pack.store(index, to.index + to.count);
      to.count += pack.count();
      // A full list does not grow: further candidates overwrite the padding behind it.
      fits = fits && to.count <= kMaxCandidates;
      to.count = std::min(to.count, kMaxCandidates);
    }
  });
  return fits;
}

/// Ellipsoids that may come within the limit of some point of the box.
HWY_INLINE M not_beyond(const BoundPlanes& at, V3 slope, V3 half, V limit) {
  // The comparison is "not above" rather than "below", because a NaN plane bounds nothing.
  return hn::Not(hn::Gt(hn::Sub(at.base, dot(absolute(slope), half)), limit));
}

/// Lists for each range, by rising index, the candidates among the source's ellipsoids; the boxes lie in
/// `around`. An ellipsoid is a candidate if
/// 1. it is not dominated, or comes within `beyond_m` of the nearest ellipsoid somewhere in the box, and
/// 2. it may come within `limit_m` of some point of the box (kNoLimit_m: always).
/// False on overflow: more than kMaxCandidates.
template <bool kLimited, class Source>
HWY_INLINE bool collect_not_dominated(const Source& source, const Aabb& around, const LaneRange* ranges,
                                      int count, const Dominators* dominators, float beyond_m, float limit_m,
                                      CandidateList* out) {
  const RangeRounding rounding(ranges, count);
  const auto keep = [&](const BallLanes& lanes, const BoundPlanes& at, int i) {
    const V beyond = all(beyond_m + 2.0f * rounding.m[i]);  // error of the plane and of the dominator
    const V3 slope = slope_of(lanes, at), half = broadcast3(ranges[i].box.half);
    const M chosen = not_dominated(at, slope, half, dominators[i], beyond);
    if constexpr (!kLimited) return chosen;
    return hn::And(chosen, not_beyond(at, slope, half, all(limit_m + rounding.m[i])));
  };
  const float within_m = farthest_corner_m(dominators, count) + beyond_m;
  return collect_candidates(source, around, kLimited ? std::min(within_m, limit_m) : within_m, ranges, count,
                            out, keep);
}

/// Finds the two dominators of each range, then its candidates as collect_not_dominated() does.
template <bool kLimited, class Source>
HWY_INLINE bool find_candidates(const Source& source, const Aabb& around, const LaneRange* ranges, int count,
                                float beyond_m, float limit_m, CandidateList* out) {
  Dominators dominators[kBlocks];
  find_dominators(source, around, ranges, count, dominators);
  measure_corners(source, ranges, count, dominators);
  return collect_not_dominated<kLimited>(source, around, ranges, count, dominators, beyond_m, limit_m, out);
}

/// Lists for each range, by rising index, the ellipsoids of the source that may come within `limit_m` of some
/// point of its box. False on overflow.
template <class Source>
HWY_INLINE bool find_candidates_below(const Source& source, const Aabb& around, const LaneRange* ranges,
                                      int count, float limit_m, CandidateList* out) {
  const RangeRounding rounding(ranges, count);
  const auto keep = [&](const BallLanes& lanes, const BoundPlanes& at, int i) {
    return not_beyond(at, slope_of(lanes, at), broadcast3(ranges[i].box.half), all(limit_m + rounding.m[i]));
  };
  return collect_candidates(source, around, limit_m, ranges, count, out, keep);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
