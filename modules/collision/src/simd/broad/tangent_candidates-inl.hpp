// AABBs of particles, and the candidates of a block for a response with fillets.
// The signed distance to a convex body is convex, so that its tangent plane at the block's middle q bounds it
// from below everywhere: d_k(p) >= d_k(q) + n_k . (p - q).
#if defined(BODICE_COLLISION_TANGENT_CANDIDATES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_TANGENT_CANDIDATES_INL_
#undef BODICE_COLLISION_TANGENT_CANDIDATES_INL_
#else
#define BODICE_COLLISION_TANGENT_CANDIDATES_INL_
#endif

#include <cstring>

#include "model/batch.hpp"
#include "model/tolerances.hpp"
#include "simd/ellipsoid/closest_point-inl.hpp"
#include "simd/math/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The ellipsoids near a block and their tangent planes at its middle.
struct TangentCandidates {
  int count = 0;
  alignas(64) std::int32_t index[kMaxCandidates + 16];
  alignas(64) float distance[kMaxCandidates + 16];
  alignas(64) float nx[kMaxCandidates + 16], ny[kMaxCandidates + 16], nz[kMaxCandidates + 16];
  float middle[3];
  float slack_m = 0.0f;   ///< error of distances and planes over the block
  float radius_m = 0.0f;  ///< half the diagonal of the block's box
  float reach_m = 0.0f;   ///< pushes up to this long reach no other ellipsoid
};

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

/// Exact distance and normal at the block's middle for the ellipsoids with boxes within `window` of the
/// block's. False on overflow. `least` is set to the least distance, or to 1e30.
HWY_INLINE bool collect_tangents(const Baked& baked, const Aabb& e, float window, TangentCandidates& out,
                                 float& least) {
  const std::size_t width = hn::Lanes(f);
  const V3 middle = broadcast3(e.middle);
  V lowest = all(1e30f);
  std::memcpy(out.middle, e.middle, sizeof(out.middle));
  out.count = 0;
  for (std::size_t k = 0; k < baked.cull.shortest.size(); k += width) {
    // The distance to a box is zero inside it, whatever the depth.
    const M near = hn::Le(box_distance(baked.cull, e, k), all(std::max(window, 0.0f)));
    if (hn::AllFalse(f, near)) continue;
    if (out.count + static_cast<int>(width) > kMaxCandidates) return false;
    const Shape shape = consecutive(baked.cull, k);
    const ClosestPointLanes closest = closest_point(shape, middle);
    const V3 normal = normal_of(shape, closest);
    lowest = hn::Min(lowest, hn::IfThenElse(near, closest.distance, all(1e30f)));
    const VI index = lanes_from(static_cast<int>(k));
    const int at = out.count;
    const Pack pack(near);
    pack.store(closest.distance, out.distance + at);
    pack.store(normal.x, out.nx + at);
    pack.store(normal.y, out.ny + at);
    pack.store(normal.z, out.nz + at);
    pack.store(index, out.index + at);
    out.count += pack.count();
  }
  least = hn::GetLane(hn::MinOfLanes(f, lowest));
  return true;
}

/// Keeps the candidates with tangent planes that come within `window` of some point of the block's box, and
/// moves the one nearest to its middle to the front.
HWY_INLINE void drop_beyond_window(const Aabb& e, float window, TangentCandidates& c) {
  int count = 0, nearest = 0;
  for (int i = 0; i < c.count; ++i) {
    const float reach =
        std::abs(c.nx[i]) * e.half[0] + std::abs(c.ny[i]) * e.half[1] + std::abs(c.nz[i]) * e.half[2];
    if (c.distance[i] - reach > window) continue;
    c.index[count] = c.index[i];
    c.distance[count] = c.distance[i];
    c.nx[count] = c.nx[i];
    c.ny[count] = c.ny[i];
    c.nz[count] = c.nz[i];
    if (c.distance[count] < c.distance[nearest]) nearest = count;
    ++count;
  }
  c.count = count;
  if (nearest == 0) return;
  std::swap(c.index[0], c.index[nearest]);
  std::swap(c.distance[0], c.distance[nearest]);
  std::swap(c.nx[0], c.nx[nearest]);
  std::swap(c.ny[0], c.ny[nearest]);
  std::swap(c.nz[0], c.nz[nearest]);
}

/// All ellipsoids that some particle of the block violates the clearance of, or can be pushed into.
HWY_INLINE bool cull_for_response(const Baked& baked, const ParticleBatch& block, float clearance_m,
                                  TangentCandidates& out) {
  const Aabb e = aabb_of(block);
  out.radius_m = e.radius;
  const float slack = out.slack_m = baked.rounding_m + rounding_over(e);
  float least;
  if (!collect_tangents(baked, e, clearance_m + slack, out, least)) return false;
  const float depth = clearance_m + slack - (least - e.radius);
  if (out.count == 0 || depth <= 0.0f) {
    out.count = 0;
    return true;
  }
  // A push can be longer than the depth where surfaces meet; longer ones than this are left to the exact
  // side.
  out.reach_m = 1.5f * depth;
  const float window = clearance_m + out.reach_m + slack;
  if (!collect_tangents(baked, e, window, out, least)) return false;
  drop_beyond_window(e, window, out);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
