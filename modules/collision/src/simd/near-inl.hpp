// Which ellipsoids can be the nearest of some place in a box, for the boxes of a batch's blocks. With d_j
// convex and the tangent plane of another ellipsoid k below d_k, d_j minus the plane is convex, so that it is
// largest at a corner of the box: if j is nearer than k's plane at all eight, k is nowhere the nearest.
#if defined(BODICE_COLLISION_NEAR_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NEAR_INL_
#undef BODICE_COLLISION_NEAR_INL_
#else
#define BODICE_COLLISION_NEAR_INL_
#endif

#include <cstdint>

#include "simd/cull-inl.hpp"
#include "simd/lookup-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kBlocks = kBatch / kBlock;

struct Near {
  int count = 0;
  alignas(64) std::int32_t index[kMaxCandidates + 16];
};

/// The numbers of ellipsoid k + lane.
struct BoundLanes {
  V3 a0, a1, a2, offset, inverse_radius;
};

HWY_INLINE BoundLanes bound_lanes(const CullArrays& c, std::size_t k) {
  const auto row = [&](int i) {
    return V3{hn::LoadU(f, c.bound[i].data() + k), hn::LoadU(f, c.bound[i + 1].data() + k),
              hn::LoadU(f, c.bound[i + 2].data() + k)};
  };
  return {row(0), row(3), row(6), row(kBoundOffset), row(kBoundInverse)};
}

/// The plane that bounds the distances to ellipsoid k + lane from below: base + slope . (p - middle), base
/// being the first-order distance at the middle; NaN at a centre: no bound.
struct Planes {
  V base, scale;
  V3 u;
};

HWY_INLINE Planes planes_at(const BoundLanes& e, V3 middle) {
  const V3 u = V3{dot(e.a0, middle), dot(e.a1, middle), dot(e.a2, middle)} + e.offset;
  const V3 v = {hn::Mul(u.x, e.inverse_radius.x), hn::Mul(u.y, e.inverse_radius.y),
                hn::Mul(u.z, e.inverse_radius.z)};
  const V square = dot(u, u), scale = inverse_sqrt(dot(v, v));
  return {hn::Mul(hn::NegMulAdd(square, inverse_sqrt(square), square), scale), scale, u};
}

HWY_INLINE V3 slope_of(const BoundLanes& e, const Planes& at) {
  return scaled(along(along(scaled(e.a0, at.u.x), at.u.y, e.a1), at.u.z, e.a2), at.scale);
}

constexpr int kCorners = 8, kRivals = 2;
static_assert(kRivals * kCorners % kWidth == 0);

/// Two ellipsoids that are probably the nearest of a box, and their exact distances at its corners.
struct Rivals {
  std::int32_t index[kRivals];
  alignas(64) float distance[kRivals * kCorners];
};

/// Per lane, the ellipsoid of the least distance at the middle.
struct LaneLeast {
  V distance;
  VI index;
};

/// The least of all lanes, and the least of the other lanes: good enough for a rival.
HWY_INLINE void pick_rivals(LaneLeast least, Rivals& out) {
  alignas(64) std::int32_t index[kWidth];
  hn::Store(least.index, I(), index);
  for (std::int32_t& rival : out.index) {
    const V lowest = hn::MinOfLanes(f, least.distance);
    const M which = hn::Eq(least.distance, lowest);
    const auto lane = hn::FindFirstTrue(f, which);
    rival = index[lane < 0 ? 0 : lane];
    least.distance = hn::IfThenElse(which, all(1e30f), least.distance);
  }
}

HWY_INLINE void find_rivals(const Baked& baked, const Extent* boxes, int blocks, Rivals* out) {
  LaneLeast least[kBlocks];
  for (LaneLeast& l : least) l = {all(1e30f), hn::Zero(I())};
  const VI end = hn::Set(I(), static_cast<std::int32_t>(baked.size()));
  for (std::size_t k = 0; k < baked.cull.shortest.size(); k += kWidth) {
    const BoundLanes lanes = bound_lanes(baked.cull, k);
    const VI index = hn::Iota(I(), static_cast<std::int32_t>(k));
    const M real = hn::RebindMask(f, hn::Lt(index, end));
    for (int block = 0; block < blocks; ++block) {
      const V distance = planes_at(lanes, broadcast3(boxes[block].middle)).base;
      const M nearer = hn::And(real, hn::Lt(distance, least[block].distance));
      least[block].distance = hn::IfThenElse(nearer, distance, least[block].distance);
      least[block].index = hn::IfThenElse(hn::RebindMask(I(), nearer), index, least[block].index);
    }
  }
  for (int block = 0; block < blocks; ++block) pick_rivals(least[block], out[block]);
}

HWY_INLINE void measure_corners(const Baked& baked, const Extent& e, Rivals& out) {
  alignas(64) static constexpr float kSide[3][kRivals * kCorners] = {
      {-1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1},
      {-1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1},
      {-1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, 1, 1, 1, 1}};
  const V3 middle = broadcast3(e.middle), half = broadcast3(e.half);
  for (int i = 0; i < kRivals * kCorners; i += kWidth) {
    const V3 corner = {hn::MulAdd(half.x, hn::Load(f, kSide[0] + i), middle.x),
                       hn::MulAdd(half.y, hn::Load(f, kSide[1] + i), middle.y),
                       hn::MulAdd(half.z, hn::Load(f, kSide[2] + i), middle.z)};
    const auto shape = [&](int r) {
      return broadcast(baked.ellipsoids[static_cast<std::size_t>(out.index[r])]);
    };
    Shape s = shape(i / kCorners);
    if constexpr (kWidth > kCorners) s = select(hn::FirstN(f, kCorners), s, shape(1));
    hn::Store(foot_of(s, corner).distance, f, out.distance + i);
  }
}

/// Ellipsoids that no rival beats by more than `beyond` at every corner.
HWY_INLINE M unbeaten(const Planes& at, V3 slope, V3 half, const Rivals& rivals, V beyond) {
  const V3 reach = {hn::Mul(slope.x, half.x), hn::Mul(slope.y, half.y), hn::Mul(slope.z, half.z)};
  const V x[2] = {hn::Sub(at.base, reach.x), hn::Add(at.base, reach.x)};
  V lead[kRivals] = {all(1e30f), all(1e30f)};
  for (int corner = 0; corner < kCorners; ++corner) {
    const V xy = corner & 2 ? hn::Add(x[corner & 1], reach.y) : hn::Sub(x[corner & 1], reach.y);
    const V plane = corner & 4 ? hn::Add(xy, reach.z) : hn::Sub(xy, reach.z);
    for (int r = 0; r < kRivals; ++r)
      lead[r] = hn::Min(lead[r], hn::Sub(plane, all(rivals.distance[r * kCorners + corner])));
  }
  return hn::Not(hn::And(hn::Gt(hn::Max(lead[0], lead[1]), beyond), hn::Eq(at.base, at.base)));
}

/// For each block of the batch all ellipsoids that can be the nearest of a place in its box, or within
/// `beyond_m` of the nearest, by rising index; false if they are more than kMaxCandidates.
inline bool find_near(const Baked& baked, const Extent* boxes, int blocks, float beyond_m, Near* out) {
  Rivals rivals[kBlocks];
  find_rivals(baked, boxes, blocks, rivals);
  for (int block = 0; block < blocks; ++block) {
    measure_corners(baked, boxes[block], rivals[block]);
    out[block].count = 0;
  }
  const VI end = hn::Set(I(), static_cast<std::int32_t>(baked.size()));
  const V beyond = all(beyond_m + 4.0f * baked.rounding_m);
  for (std::size_t k = 0; k < baked.cull.shortest.size(); k += kWidth) {
    const BoundLanes lanes = bound_lanes(baked.cull, k);
    const VI index = hn::Iota(I(), static_cast<std::int32_t>(k));
    const M real = hn::RebindMask(f, hn::Lt(index, end));
    for (int block = 0; block < blocks; ++block) {
      Near& to = out[block];
      if (to.count + kWidth > kMaxCandidates) return false;
      const Planes at = planes_at(lanes, broadcast3(boxes[block].middle));
      const M keep = hn::And(
          real, unbeaten(at, slope_of(lanes, at), broadcast3(boxes[block].half), rivals[block], beyond));
      hn::StoreU(hn::Compress(index, hn::RebindMask(I(), keep)), I(), to.index + to.count);
      to.count += static_cast<int>(hn::CountTrue(f, keep));
    }
  }
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
