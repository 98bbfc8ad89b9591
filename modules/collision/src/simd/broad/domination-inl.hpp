// The rules by which candidates of boxes are found. Candidates are ellipsoids that no other ellipsoid
// dominates. The distance d_j is convex, and the tangent plane of another ellipsoid k lies below d_k. Hence
// d_j minus the plane is convex and largest at a corner of the box. If d_j is less than the plane at all
// eight corners, j dominates k: it is nearer everywhere in the box.
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
#include <span>

#include "simd/broad/search-inl.hpp"
#include "simd/ellipsoid/closest_point-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

constexpr int kDominators = 2;
static_assert(kDominators * kCorners % kWidth == 0);
static_assert(kGroup % kWidth == 0);

/// rounding_over() the box of each range.
struct RangeRounding {
  float m[kBlocks];

  HWY_INLINE RangeRounding(const LaneRange* ranges, int count) {
    for (int i = 0; i < count; ++i) m[i] = rounding_over(ranges[i].box);
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

/// In each lane, the ellipsoid of least distance to the middle among those that this lane has seen.
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

/// The ellipsoids of a source within `within_m` of a box.
template <class Source>
struct Vicinity {
  const Source& source;
  const Aabb& around;
  float within_m;
};

/// Lists for each range, by rising index, the ellipsoids of the vicinity that keep(bounds, planes at the
/// middle, range) accepts. False if there are more than kMaxCandidates.
template <class Source, class Keep>
HWY_INLINE bool collect_candidates(const Vicinity<Source>& from, const LaneRange* ranges, int count,
                                   CandidateList* out, Keep&& keep) {
  for (int i = 0; i < count; ++i) out[i].count = 0;
  const VI end = hn::Set(I(), from.source.end);
  bool fits = true;
  from.source.for_vectors(from.around, from.within_m, [&](int k) {
    const BallLanes lanes = from.source.balls(k);
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

/// The rule by which candidates are found among the ellipsoids of a source. An ellipsoid is a candidate if
/// 1. it is not dominated, or comes within `beyond_m` of the nearest ellipsoid somewhere in the box, and
/// 2. it may come within `limit_m` of some point of the box (only if kLimited).
template <bool kLimited>
struct NotDominated {
  float beyond_m;
  float limit_m = kNoLimit_m;

  template <class Source>
  HWY_INLINE bool operator()(const Source& source, const Aabb& around, const LaneRange* ranges, int count,
                             CandidateList* out) const {
    Dominators dominators[kBlocks];
    find_dominators(source, around, ranges, count, dominators);
    measure_corners(source, ranges, count, dominators);
    return collect(source, around, ranges, std::span(dominators, static_cast<std::size_t>(count)), out);
  }

  /// The candidates of ranges, one list each, given their dominators.
  template <class Source>
  HWY_INLINE bool collect(const Source& source, const Aabb& around, const LaneRange* ranges,
                          std::span<const Dominators> dominators, CandidateList* out) const {
    const int count = static_cast<int>(dominators.size());
    const RangeRounding rounding(ranges, count);
    const auto keep = [&](const BallLanes& lanes, const BoundPlanes& at, int i) {
      const V beyond = all(beyond_m + 2.0f * rounding.m[i]);  // error of the plane and of the dominator
      const V3 slope = slope_of(lanes, at), half = broadcast3(ranges[i].box.half);
      const M chosen = not_dominated(at, slope, half, dominators.data()[i], beyond);
      if constexpr (!kLimited) return chosen;
      return hn::And(chosen, not_beyond(at, slope, half, all(limit_m + rounding.m[i])));
    };
    const float within_m = farthest_corner_m(dominators.data(), count) + beyond_m;
    const float least_m = kLimited ? std::min(within_m, limit_m) : within_m;
    return collect_candidates(Vicinity<Source>{source, around, least_m}, ranges, count, out, keep);
  }
};

/// The rule of the ellipsoids that may come within `limit_m` of some point of the box.
struct NotBeyond {
  float limit_m;

  template <class Source>
  HWY_INLINE bool operator()(const Source& source, const Aabb& around, const LaneRange* ranges, int count,
                             CandidateList* out) const {
    const RangeRounding rounding(ranges, count);
    const auto keep = [&](const BallLanes& lanes, const BoundPlanes& at, int i) {
      return not_beyond(at, slope_of(lanes, at), broadcast3(ranges[i].box.half),
                        all(limit_m + rounding.m[i]));
    };
    return collect_candidates(Vicinity<Source>{source, around, limit_m}, ranges, count, out, keep);
  }
};

/// The rule of a query with a contact distance. A limit that is small beside the blocks leaves about as few
/// candidates as domination, which costs a dozen closest points a block.
struct NotBeyondNorDominated {
  NotDominated<true> rule;
  bool close;  ///< the limit alone is applied

  HWY_INLINE NotBeyondNorDominated(float limit_m, float beyond_m, const Aabb& first_block)
      : rule{beyond_m, limit_m + beyond_m}, close(limit_m <= first_block.radius) {}

  template <class Source>
  HWY_INLINE bool operator()(const Source& source, const Aabb& around, const LaneRange* ranges, int count,
                             CandidateList* out) const {
    if (close) return NotBeyond{rule.limit_m}(source, around, ranges, count, out);
    return rule(source, around, ranges, count, out);
  }
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
