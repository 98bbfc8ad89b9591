// Combines the results of a particle's candidates into one.
#if defined(BODICE_COLLISION_COMBINE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_COMBINE_INL_
#undef BODICE_COLLISION_COMBINE_INL_
#else
#define BODICE_COLLISION_COMBINE_INL_
#endif

#include <algorithm>
#include <bit>
#include <cstring>

#include "model/fallback.hpp"
#include "simd/ellipsoid/relief_table-inl.hpp"
#include "simd/narrow/pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// Plain ellipsoids: takes the nearest; of equally near ones that of the lowest index.
HWY_INLINE void combine_nearest(const Pairs& pairs, BatchResults& out) {
  const auto& a = pairs.results;
  for (int i = 0; i < pairs.count; ++i) {
    // Selects without a branch, since which of two neighbors is nearer cannot be predicted.
    const int lane = pairs.lane[i];
    const float d = a.distance[i], least = out.distance[lane];
    const bool nearer = (d < least) | ((d == least) & (a.proxy_index[i] < out.proxy_index[lane]));
    out.distance[lane] = nearer ? d : least;
    out.gx[lane] = nearer ? a.gx[i] : out.gx[lane];
    out.gy[lane] = nearer ? a.gy[i] : out.gy[lane];
    out.gz[lane] = nearer ? a.gz[i] : out.gz[lane];
    out.proxy_index[lane] = nearer ? a.proxy_index[i] : out.proxy_index[lane];
  }
}

/// Finds the lanes for which a pair is nearer than the first result, and sets their least distance and owner.
HWY_INLINE void find_nearer(const Pairs& pairs, float* least, BatchResults& out) {
  const auto& a = pairs.results;
  for (int i = 0; i < pairs.count; i += kWidth) {
    const V first = hn::GatherIndex(f, least, hn::Load(I(), pairs.lane + i));
    const M maybe = hn::And(hn::Le(hn::Load(f, a.distance + i), first), lanes_below(i, pairs.count));
    // Few pairs remain here, because the candidate with the least bound is nearly always the nearest. A lane
    // may be among them more than once.
    for (std::uint64_t left = bits(maybe); left != 0; left &= left - 1) {
      const int k = i + std::countr_zero(left), lane = pairs.lane[k];
      const bool farther = a.distance[k] > least[lane];
      if (farther || (a.distance[k] == least[lane] && a.proxy_index[k] > out.proxy_index[lane])) continue;
      least[lane] = a.distance[k];
      out.proxy_index[lane] = a.proxy_index[k];
    }
  }
}

/// Sets the least distance of each lane, in place of that of its first result.
HWY_INLINE void find_least_unburied(const Pairs& pairs, BatchResults& out) {
  for (int i = 0; i < pairs.count; ++i) {
    float& least = out.unburied[pairs.lane[i]];
    least = std::min(least, pairs.results.unburied[i]);
  }
}

/// Replaces the least distance of some lanes by their least score if that is higher by more than `certain_m`,
/// and else by kCertain.
HWY_INLINE void mark_uncertain(LaneSpan lanes, const float* least, float certain_m, BatchResults& out) {
  for (int i = lanes.begin; i < lanes.end; i += kWidth) {
    const V score = hn::Load(f, least + i), excess = hn::Sub(score, hn::Load(f, out.unburied + i));
    const M certain = hn::Le(excess, all(certain_m));
    hn::Store(hn::IfThenElse(certain, all(kCertain), score), f, out.unburied + i);
  }
}

/// Weighted sums. The four numbers of a lane are consecutive, so that adding those of a pair takes one
/// instruction.
struct alignas(64) WeightedRows {
  static constexpr int kNumbers = 4;  // value and gradient
  float row[Pairs::kSize * kNumbers];
  float weight[Pairs::kSize];

  template <int kSize>
  HWY_INLINE void put(const ResultRows<kSize>& of, V weights, int i) {
    const auto weighted = [&](const float* values) { return hn::Mul(hn::Load(f, values + i), weights); };
    hn::Store(weights, f, weight + i);
    hn::StoreInterleaved4(weighted(of.value), weighted(of.gx), weighted(of.gy), weighted(of.gz), f,
                          row + kNumbers * i);
  }
  HWY_INLINE void add(int lane, const WeightedRows& other, int i) {
    weight[lane] += other.weight[i];
    float* const to = row + kNumbers * lane;
    const float* const from = other.row + kNumbers * i;
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < kNumbers; ++k) to[k] += from[k];
#else
    constexpr hn::FixedTag<float, kNumbers> four;
    hn::Store(hn::Add(hn::Load(four, to), hn::Load(four, from)), four, to);
#endif
  }
};

/// Relief, for some lanes: blends all results within the blend radius of the nearest. Sets
/// distance and unit gradient of the blend and the owner; `value` becomes the length of the gradient. In a
/// pose it marks the lanes that are uncertain.
template <bool kBuries>
HWY_INLINE void combine_blended(const ProxyModel& model, LaneSpan lanes, const Pairs& pairs,
                                BatchResults& out) {
  const auto [begin, end] = lanes;
  alignas(64) float least[kBatch];
  WeightedRows sums, of_pairs;
  const V per_blend = all(1.0f / model.blend_m());
  std::memcpy(least + begin, out.distance + begin, static_cast<std::size_t>(end - begin) * sizeof(float));
  find_nearer(pairs, least, out);
  if constexpr (kBuries) {
    find_least_unburied(pairs, out);
    mark_uncertain(lanes, least, model.certain_m(), out);
  }
  for (int i = begin; i < end; i += kWidth)
    sums.put(out, blend_weight(hn::Load(f, out.distance + i), hn::Load(f, least + i), per_blend), i);
  for (int i = 0; i < pairs.count; i += kWidth) {
    const V near = hn::GatherIndex(f, least, hn::Load(I(), pairs.lane + i));
    of_pairs.put(pairs.results, blend_weight(hn::Load(f, pairs.results.distance + i), near, per_blend), i);
  }
  for (int i = 0; i < pairs.count; ++i) sums.add(pairs.lane[i], of_pairs, i);
  for (int i = begin; i < end; i += kWidth) {
    V value;
    V3 sum;
    hn::LoadInterleaved4(f, sums.row + WeightedRows::kNumbers * i, value, sum.x, sum.y, sum.z);
    const V per_weight = reciprocal(hn::Load(f, sums.weight + i));
    hn::Store(hn::Mul(value, per_weight), f, out.distance + i);
    const V norm2 = dot(sum, sum), per_norm = inverse_sqrt(hn::Max(norm2, all(kLeastNorm2)));
    store3(scaled(sum, per_norm), out.gx + i, out.gy + i, out.gz + i);
    hn::Store(hn::Mul(hn::Mul(norm2, per_norm), per_weight), f, out.value + i);
  }
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
