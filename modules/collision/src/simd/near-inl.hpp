// Which ellipsoids can be the nearest of some place in a box.
#if defined(BODICE_COLLISION_NEAR_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_NEAR_INL_
#undef BODICE_COLLISION_NEAR_INL_
#else
#define BODICE_COLLISION_NEAR_INL_
#endif

#include <cstdint>

#include "simd/cull-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr std::size_t kCullChunk = 128;  // ellipsoids between two looks at the upper bound

struct Near {
  int count = 0;
  alignas(64) std::int32_t index[kMaxCandidates + 16];
  alignas(64) float low[kMaxCandidates + 16];  ///< no place of the box is nearer than this, metres
};

HWY_INLINE V3 bound_row(const CullArrays& c, int i, std::size_t k) {
  return {hn::LoadU(f, c.bound[i].data() + k), hn::LoadU(f, c.bound[i + 1].data() + k),
          hn::LoadU(f, c.bound[i + 2].data() + k)};
}

/// Bounds of the distance to ellipsoid k + lane: from below at any place of the box (NaN: none), from above
/// at its middle.
struct Bracket {
  V low, high;
};

HWY_INLINE Bracket bracket(const CullArrays& c, const Extent& e, V3 middle, std::size_t k) {
  const V3 a0 = bound_row(c, 0, k), a1 = bound_row(c, 3, k), a2 = bound_row(c, 6, k);
  const V3 u = V3{dot(a0, middle), dot(a1, middle), dot(a2, middle)} + bound_row(c, kBoundOffset, k);
  const V3 g = bound_row(c, kBoundInverse, k);
  const V3 v = {hn::Mul(u.x, g.x), hn::Mul(u.y, g.y), hn::Mul(u.z, g.z)};
  const V square = dot(u, u), inverse_k0 = inverse_sqrt(square), k0 = hn::Mul(square, inverse_k0);
  // The tangent plane of k0, at the corner of the box that is deepest behind it.
  const V3 slope = along(along(scaled(a0, u.x), u.y, a1), u.z, a2);
  const V3 half = broadcast3(e.half);
  const V reach = dot(absolute(slope), half);
  const V low = hn::Mul(hn::Sub(square, hn::Add(k0, reach)), inverse_sqrt(dot(v, v)));
  // On the ray from the centre outside, to the shortest axis's share inside: no distance is longer.
  const V3 q = middle - V3{hn::LoadU(f, c.center[0].data() + k), hn::LoadU(f, c.center[1].data() + k),
                           hn::LoadU(f, c.center[2].data() + k)};
  const V excess = hn::Sub(k0, all(1.0f));
  const V ray = hn::Mul(hn::Sqrt(dot(q, q)), inverse_k0);
  const M outside = hn::Gt(excess, hn::Zero(f));
  return {low, hn::Mul(excess, hn::IfThenElse(outside, ray, hn::LoadU(f, c.shortest.data() + k)))};
}

/// Drops what is above the window.
HWY_INLINE void narrow(float window, Near& near) {
  int kept = 0;
  for (int i = 0; i < near.count; ++i) {
    near.index[kept] = near.index[i];
    near.low[kept] = near.low[i];
    kept += !(near.low[i] > window);
  }
  near.count = kept;
}

/// All ellipsoids that can be the nearest of a place in the box, or within `beyond_m` of the nearest, by
/// rising index; false if they are more than kMaxCandidates.
HWY_INLINE bool near_box(const Baked& baked, const Extent& e, float beyond_m, Near& out) {
  const V3 middle = broadcast3(e.middle);
  const float slack = e.radius * (1.0f + 4e-6f) + 4.0f * baked.rounding_m + beyond_m;
  const std::size_t padded = baked.cull.shortest.size();
  const VI end = hn::Set(I(), static_cast<std::int32_t>(baked.size()));
  V upper = all(1e30f);
  out.count = 0;
  for (std::size_t chunk = 0; chunk < padded; chunk += kCullChunk) {
    const std::size_t chunk_end = std::min(padded, chunk + kCullChunk);
    alignas(64) float low[kCullChunk];
    for (std::size_t k = chunk; k < chunk_end; k += kWidth) {
      const Bracket b = bracket(baked.cull, e, middle, k);
      hn::Store(b.low, f, low + (k - chunk));
      upper = hn::IfThenElse(hn::Lt(b.high, upper), b.high, upper);
    }
    const float window = hn::GetLane(hn::MinOfLanes(f, upper)) + slack;
    if (chunk > 0) narrow(window, out);
    for (std::size_t k = chunk; k < chunk_end; k += kWidth) {
      if (out.count + kWidth > kMaxCandidates) return false;
      const V here = hn::Load(f, low + (k - chunk));
      const VI index = hn::Iota(I(), static_cast<std::int32_t>(k));
      const M keep = hn::And(hn::RebindMask(f, hn::Lt(index, end)), hn::Not(hn::Gt(here, all(window))));
      hn::StoreU(hn::Compress(index, hn::RebindMask(I(), keep)), I(), out.index + out.count);
      hn::StoreU(hn::Compress(here, keep), f, out.low + out.count);
      out.count += static_cast<int>(hn::CountTrue(f, keep));
    }
  }
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
