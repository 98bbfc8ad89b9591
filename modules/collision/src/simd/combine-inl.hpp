// One answer a particle, out of those of its ellipsoids.
#if defined(BODICE_COLLISION_COMBINE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_COMBINE_INL_
#undef BODICE_COLLISION_COMBINE_INL_
#else
#define BODICE_COLLISION_COMBINE_INL_
#endif

#include <cstring>

#include "simd/pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

using Batched = Answers<kBatch>;

/// Plain ellipsoids: the nearest; of equals, that of the lowest index.
HWY_INLINE void combine_nearest(const Pairs& pairs, Batched& out) {
  const auto& a = pairs.answers;
  for (int i = 0; i < pairs.count; ++i) {
    // Without a branch: which of two neighbours is the nearer cannot be foretold.
    const int lane = pairs.lane[i];
    const float d = a.distance[i], least = out.distance[lane];
    const bool nearer = (d < least) | ((d == least) & (a.name[i] < out.name[lane]));
    out.distance[lane] = nearer ? d : least;
    out.gx[lane] = nearer ? a.gx[i] : out.gx[lane];
    out.gy[lane] = nearer ? a.gy[i] : out.gy[lane];
    out.gz[lane] = nearer ? a.gz[i] : out.gz[lane];
    out.name[lane] = nearer ? a.name[i] : out.name[lane];
  }
}

HWY_INLINE void multiply(float* values, V by) {
  hn::StoreU(hn::Mul(hn::LoadU(f, values), by), f, values);
}

/// Relief, for the lanes [begin, end): all within the blending of the nearest, weighted; distance and
/// unit gradient of the blend, the name of the nearest; `value` becomes the gradient's length. The answers of
/// the pairs are overwritten.
HWY_INLINE void combine_blended(const ReliefTables& relief, int begin, int end, Pairs& pairs, Batched& out) {
  auto& a = pairs.answers;
  alignas(64) float least[kBatch], weight[kBatch];
  alignas(64) float pair_weight[Pairs::kSize];
  const V per_blend = all(1.0f / relief.blend_m);
  std::memcpy(least + begin, out.distance + begin, static_cast<std::size_t>(end - begin) * sizeof(float));
  for (int i = 0; i < pairs.count; ++i) {
    const int lane = pairs.lane[i];
    const bool nearer =
        a.distance[i] < least[lane] || (a.distance[i] == least[lane] && a.name[i] < out.name[lane]);
    least[lane] = nearer ? a.distance[i] : least[lane];
    out.name[lane] = nearer ? a.name[i] : out.name[lane];
  }
  for (int i = begin; i < end; i += kWidth) {
    const V w = blend_weight(hn::Load(f, out.distance + i), hn::Load(f, least + i), per_blend);
    hn::Store(w, f, weight + i);
    for (float* values : {out.value, out.gx, out.gy, out.gz}) multiply(values + i, w);
  }
  for (int i = 0; i < pairs.count; i += kWidth) {
    const V near = hn::GatherIndex(f, least, hn::Load(I(), pairs.lane + i));
    const V w = blend_weight(hn::Load(f, a.distance + i), near, per_blend);
    hn::Store(w, f, pair_weight + i);
    for (float* values : {a.value, a.gx, a.gy, a.gz}) multiply(values + i, w);
  }
  for (int i = 0; i < pairs.count; ++i) {
    const int lane = pairs.lane[i];
    weight[lane] += pair_weight[i];
    out.value[lane] += a.value[i];
    out.gx[lane] += a.gx[i];
    out.gy[lane] += a.gy[i];
    out.gz[lane] += a.gz[i];
  }
  for (int i = begin; i < end; i += kWidth) {
    const V per_weight = reciprocal(hn::Load(f, weight + i));
    hn::Store(hn::Mul(hn::Load(f, out.value + i), per_weight), f, out.distance + i);
    const V3 sum = load3(out.gx + i, out.gy + i, out.gz + i);
    const V norm2 = dot(sum, sum), per_norm = inverse_sqrt(hn::Max(norm2, all(kLeastNorm2)));
    store3(scaled(sum, per_norm), out.gx + i, out.gy + i, out.gz + i);
    hn::Store(hn::Mul(hn::Mul(norm2, per_norm), per_weight), f, out.value + i);
  }
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
