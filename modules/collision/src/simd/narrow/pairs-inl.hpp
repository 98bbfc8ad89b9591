// Lists of the narrow phase, one array a number: results of particles, pairs of a particle and an ellipsoid,
// and particles that a limit selects.
#if defined(BODICE_COLLISION_PAIRS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_PAIRS_INL_
#undef BODICE_COLLISION_PAIRS_INL_
#else
#define BODICE_COLLISION_PAIRS_INL_
#endif

#include <cstdint>

#include "model/batch.hpp"
#include "simd/ellipsoid/bound-inl.hpp"
#include "simd/math/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// The distances of kSize particles to one ellipsoid each, as arrays.
template <int kSize>
struct alignas(64) ResultRows {
  float distance[kSize];  ///< to the ellipsoid, meters; in a pose its score
  float value[kSize];     ///< relief only: corrected distance, meters
  float gx[kSize], gy[kSize],
      gz[kSize];                    ///< gradient of the value; the unit normal without relief
  std::int32_t proxy_index[kSize];  ///< index of the ellipsoid in the proxy
  /// Poses only: distance to the ellipsoid, meters. Results of lanes: kCertain, or the least score among the
  /// candidates of an uncertain particle, which another ellipsoid may own.
  float unburied[kSize];
};

/// Marks particles that are not uncertain: one of their candidates owns them. Below any score.
constexpr float kCertain = -1e30f;

/// The distances of one vector of particles, each to the ellipsoid of its column; see ResultRows.
struct Result {
  V distance, value;
  V3 gradient;
  VI proxy_index;
  V unburied;
};

using BatchResults = ResultRows<kBatch>;

/// Stores a vector of results; `value` only where results are blended, `unburied` only in poses.
template <class Union, int kSize>
HWY_INLINE void put(const Result& a, ResultRows<kSize>& to, int i) {
  hn::Store(a.distance, f, to.distance + i);
  if constexpr (Union::kBlends) hn::Store(a.value, f, to.value + i);
  if constexpr (Union::kBuries) hn::Store(a.unburied, f, to.unburied + i);
  store3(a.gradient, to.gx + i, to.gy + i, to.gz + i);
  hn::Store(a.proxy_index, I(), to.proxy_index + i);
}

/// Pairs of blocks that share columns.
struct Pairs {
  static constexpr int kCapacity = 1024;
  static constexpr int kSize = kCapacity + 32;
  alignas(64) std::int32_t lane[kSize];
  alignas(64) std::int32_t column[kSize];
  ResultRows<kSize> results;
  int count = 0;

  bool fit(int vectors) const { return count + vectors * kWidth <= kCapacity; }
  /// Adds the lanes of `mask`, each with its column.
  HWY_INLINE void add(M mask, VI lanes, VI columns) {
    const Pack pack(mask);
    pack.store(lanes, lane + count);
    pack.store(columns, column + count);
    count += pack.count();
  }
};

/// The particles of a batch that may be within the limit, closed up. Each run of those found together starts
/// at a whole step, behind repetitions of the particle before.
struct alignas(64) InRange {
  static constexpr int kMaxBounds = 3, kSize = kBatch + 2 * kStep;
  float x[kSize], y[kSize], z[kSize];
  float bound[kMaxBounds + 1][kSize];  ///< as in LowestBounds
  std::int32_t lane[kSize];            ///< in the batch; -1: a repetition
  int count = 0;
  LaneBits which;  ///< these particles as lanes of the batch

  void clear() {
    count = 0;
    which = {};
  }
  /// Adds the chosen ones of the batch's lanes [first, first + kWidth).
  template <int kLowest>
  HWY_INLINE void add(M mask, int first, V3 p, const LowestBounds<kLowest>& lowest) {
    const Pack pack(mask);
    which.add(bits(mask), first);
    pack.store(p.x, x + count);
    pack.store(p.y, y + count);
    pack.store(p.z, z + count);
    for (int i = 0; i <= kLowest; ++i) pack.store(lowest.bound[i], bound[i] + count);
    pack.store(lanes_from(first), lane + count);
    count += pack.count();
  }
  /// Repeats the last particle until the run that starts at `from` has whole steps.
  template <int kLowest>
  HWY_INLINE void pad(int from) {
    if (count == from) return;
    const int last = count - 1, end = from + (count - from + kStep - 1) / kStep * kStep;
    for (; count < end; ++count) {
      for (float* values : {x, y, z}) values[count] = values[last];
      for (int i = 0; i <= kLowest; ++i) bound[i][count] = bound[i][last];
      lane[count] = -1;
    }
  }
  template <int kLowest>
  HWY_INLINE LowestBounds<kLowest> lowest(int i) const {
    LowestBounds<kLowest> result;
    for (int k = 0; k <= kLowest; ++k) result.bound[k] = hn::Load(f, bound[k] + i);
    return result;
  }
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
