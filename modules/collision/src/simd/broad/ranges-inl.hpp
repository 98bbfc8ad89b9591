// Ranges of lanes with their AABBs, and the loads of their positions.
#if defined(BODICE_COLLISION_RANGES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_RANGES_INL_
#undef BODICE_COLLISION_RANGES_INL_
#else
#define BODICE_COLLISION_RANGES_INL_
#endif

#include <algorithm>
#include <cmath>
#include <vector>

#include <hwy/cache_control.h>

#include "model/baked.hpp"
#include "model/batch.hpp"
#include "model/candidate_cache.hpp"
#include "model/fallback.hpp"
#include "model/tolerances.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// An axis-aligned box as middle and half sides, meters; radius is half its diagonal.
struct Aabb {
  float middle[3], half[3];
  float radius;
};

HWY_INLINE void extend(V3& low, V3& high, V3 p) {
  low = {hn::Min(low.x, p.x), hn::Min(low.y, p.y), hn::Min(low.z, p.z)};
  high = {hn::Max(high.x, p.x), hn::Max(high.y, p.y), hn::Max(high.z, p.z)};
}

HWY_INLINE Aabb aabb_between(V3 low, V3 high) {
  const float lows[3] = {hn::GetLane(hn::MinOfLanes(f, low.x)), hn::GetLane(hn::MinOfLanes(f, low.y)),
                         hn::GetLane(hn::MinOfLanes(f, low.z))};
  const float highs[3] = {hn::GetLane(hn::MaxOfLanes(f, high.x)), hn::GetLane(hn::MaxOfLanes(f, high.y)),
                          hn::GetLane(hn::MaxOfLanes(f, high.z))};
  Aabb e;
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    e.middle[axis] = 0.5f * lows[axis] + 0.5f * highs[axis];
    e.half[axis] = 0.5f * highs[axis] - 0.5f * lows[axis];
    sum += e.half[axis] * e.half[axis];
  }
  e.radius = std::sqrt(sum);
  return e;
}

/// The smallest box that contains both.
HWY_INLINE Aabb united(const Aabb& a, const Aabb& b) {
  Aabb e;
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = std::min(a.middle[axis] - a.half[axis], b.middle[axis] - b.half[axis]);
    const float high = std::max(a.middle[axis] + a.half[axis], b.middle[axis] + b.half[axis]);
    e.middle[axis] = 0.5f * low + 0.5f * high;
    e.half[axis] = 0.5f * high - 0.5f * low;
    sum += e.half[axis] * e.half[axis];
  }
  e.radius = std::sqrt(sum);
  return e;
}

HWY_INLINE Aabb grown(Aabb e, float by_m) {
  float sum = 0.0f;
  for (float& half : e.half) {
    half += by_m;
    sum += half * half;
  }
  e.radius = std::sqrt(sum);
  return e;
}

/// Whether `a` contains `b`.
HWY_INLINE bool contains(const Aabb& a, const Aabb& b) {
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
    inside = inside && std::abs(b.middle[axis] - a.middle[axis]) + b.half[axis] <= a.half[axis];
  return inside;
}

/// The box of the particles. `in_float_range` is set to whether all are within kFarthest_m, which NaN is not.
HWY_INLINE Aabb aabb_of_lanes(const float* x, const float* y, const float* z, int count,
                              bool& in_float_range) {
  const auto load = [&](int i) { return V3{hn::LoadU(f, x + i), hn::LoadU(f, y + i), hn::LoadU(f, z + i)}; };
  V3 low = load(0), high = low;
  M within = hn::FirstN(f, kWidth);
  for (int i = 0; i < count; i += kWidth) {
    const V3 p = load(i), size = absolute(p);
    extend(low, high, p);
    const V most = all(kFarthest_m);
    within =
        hn::And(within, hn::And(hn::Lt(size.x, most), hn::And(hn::Lt(size.y, most), hn::Lt(size.z, most))));
  }
  in_float_range = hn::AllTrue(f, within);
  return aabb_between(low, high);
}

/// The box of the particles and of the paths from their safe positions, if there are any.
HWY_INLINE Aabb aabb_of(const ParticleBatch& block) {
  const int width = static_cast<int>(hn::Lanes(f));
  V3 low = load3(block.x, block.y, block.z), high = low;
  for (int i = width; i < block.count; i += width)
    extend(low, high, load3(block.x + i, block.y + i, block.z + i));
  for (int i = 0; block.has_safe && i < block.count; i += width)
    extend(low, high, load3(block.sx + i, block.sy + i, block.sz + i));
  return aabb_between(low, high);
}

/// Error of an ellipsoid's plane, or of a distance to it, over the box, however small the ellipsoid.
HWY_INLINE float rounding_over(const Aabb& box) {
  const float away = std::abs(box.middle[0]) + std::abs(box.middle[1]) + std::abs(box.middle[2]);
  return 2.0f * static_cast<float>(kFloatRounding) * (away + box.radius);
}

using Corner = std::vector<float>[3];

/// Distance from the block's box to the boxes [k, k + kWidth).
HWY_INLINE V box_distance(const Corner& low, const Corner& high, const Aabb& e, std::size_t k) {
  V sum = hn::Zero(f);
  for (int axis = 0; axis < 3; ++axis) {
    const V below = hn::Sub(hn::LoadU(f, low[axis].data() + k), all(e.middle[axis] + e.half[axis]));
    const V above = hn::Sub(all(e.middle[axis] - e.half[axis]), hn::LoadU(f, high[axis].data() + k));
    const V outside = hn::Max(hn::Zero(f), hn::Max(below, above));
    sum = hn::MulAdd(outside, outside, sum);
  }
  return hn::Sqrt(sum);
}

/// Distance from the block's box to those of the ellipsoids [k, k + kWidth).
HWY_INLINE V box_distance(const CullArrays& cull, const Aabb& e, std::size_t k) {
  return box_distance(cull.low, cull.high, e, k);
}

constexpr int kBlocks = kBatch / kBlock;

/// Consecutive lanes of a batch and their AABB.
struct LaneRange {
  Aabb box;
  int begin, end;
};

/// End of the range's lanes, rounded up to whole steps.
HWY_INLINE int end_of(const LaneRange& range) {
  return range.begin + (range.end - range.begin + kStep - 1) / kStep * kStep;
}

/// A span of lanes, divided into blocks.
struct Blocks {
  LaneRange ranges[kBlocks];
  int count = 0;
  bool in_float_range = true;  ///< all particles are within kFarthest_m, which NaN is not

  /// `lanes` are at least one.
  HWY_INLINE Blocks(const Positions& at, LaneSpan lanes) {
    int begin = lanes.begin;
    do {
      const int end = std::min(begin + kBlock, lanes.end);
      bool these = false;
      ranges[count++] = {aabb_of_lanes(at.x + begin, at.y + begin, at.z + begin, end - begin, these), begin,
                         end};
      in_float_range = in_float_range && these;
      begin = end;
    } while (begin < lanes.end);
  }
  /// Stores the radii of a whole batch's blocks.
  HWY_INLINE void note_radii(float* radius_m) const {
    for (int i = 0; i < count; ++i) radius_m[i] = ranges[i].box.radius;
  }
};

/// Indices of candidates, rising; whole vectors are written behind the last.
struct CandidateList {
  int count = 0;
  alignas(64) std::int32_t index[kMaxCandidates + 16];
};

/// Prefetches the same lanes of the next batch, a few at a time, since all at once would delay this batch's
/// own reads. It is inlined, because g++ drops calls of a function that only prefetches.
template <int kLanes>
HWY_INLINE void prefetch_step(const NextBatch& next, int from) {
  constexpr int kLine = 64 / sizeof(float);
  for (int i = from; next.cached && i < from + kLanes; i += kLine) {
    hwy::Prefetch(next.cached->x + i);
    hwy::Prefetch(next.cached->y + i);
    hwy::Prefetch(next.cached->z + i);
    hwy::Prefetch(next.cached->slack_m[0] + i);
  }
  if (from + kLanes > next.count) return;
  for (int i = from; next.x && i < from + kLanes; i += kLine) {
    hwy::Prefetch(next.x + i);
    hwy::Prefetch(next.y + i);
    hwy::Prefetch(next.z + i);
  }
  if (!next.contacts) return;
  if (next.index)
    for (int i = from; i < from + kLanes; ++i) __builtin_prefetch(next.contacts + next.index[i], 1);
  else
    for (int i = from; i < from + kLanes; i += 2) __builtin_prefetch(next.contacts + i, 1);
}

/// Loads the positions of kCount vectors, from lane `from` on.
template <int kCount>
HWY_INLINE void load_step(const Batch& batch, int from, V3 (&p)[kCount]) {
  prefetch_step<kCount * kWidth>(batch.next, from);
  for (int v = 0; v < kCount; ++v) {
    const int i = from + v * kWidth;
    p[v] = {hn::LoadU(f, batch.at.x + i), hn::LoadU(f, batch.at.y + i), hn::LoadU(f, batch.at.z + i)};
  }
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
