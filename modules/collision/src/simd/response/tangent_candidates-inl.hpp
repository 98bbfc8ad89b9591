// The candidates of a block for a response with fillets. The signed distance to a convex body is convex, so
// that its tangent plane at the block's middle q bounds it from below everywhere: d_k(p) >= d_k(q) + n_k . (p
// - q).
#if defined(BODICE_COLLISION_TANGENT_CANDIDATES_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_TANGENT_CANDIDATES_INL_
#undef BODICE_COLLISION_TANGENT_CANDIDATES_INL_
#else
#define BODICE_COLLISION_TANGENT_CANDIDATES_INL_
#endif

#include <cstring>
#include <utility>

#include "model/batch.hpp"
#include "model/tolerances.hpp"
#include "simd/broad/ranges-inl.hpp"
#include "simd/ellipsoid/closest_point-inl.hpp"
#include "simd/math/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

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

/// Lower bound on candidate i's distance at p, by its tangent plane.
HWY_INLINE V tangent_bound(const TangentCandidates& c, int i, V3 p) {
  const V3 offset = p - broadcast3(c.middle);
  return hn::MulAdd(
      all(c.nx[i]), offset.x,
      hn::MulAdd(all(c.ny[i]), offset.y, hn::MulAdd(all(c.nz[i]), offset.z, all(c.distance[i]))));
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
